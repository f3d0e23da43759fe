"""The one place that speaks of faults: for each kind what happened, whether the data are safe, and what to do.

Short main clauses in the present tense; the program is Carpus, the person is not blamed. ``{subject}`` and
``{detail}`` are the facts of the fault. The texts are English phrases, which a window translates before filling.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

from carpus.core import errors
from carpus.core.calibration.result import Finding
from carpus.core.errors import CarpusFault
from carpus.core.installing import how_to_install
from carpus.core.phrase import Phrase, phrase

Say = Callable[[str], str]
"""Says a :class:`Phrase` in a language, any other text as it is."""


@dataclass(frozen=True, slots=True)
class Words:
    """The three answers of every message."""

    happened: str
    safe: str
    do: str


@dataclass(frozen=True, slots=True)
class FindingWords:
    """What is not as it should be at calibration, and how to mend it."""

    headline: str
    remedy: str


_UNTOUCHED = phrase("Nothing has been changed, and nothing is lost.")
_NOTHING_YET = phrase("Nothing has been recorded, so nothing is lost.")
_HAND = phrase("hand")
_BINDING = " (for|at|to|in|für|auf|nach|unter|per|su|a) "
"""What binds a fact to its sentence, in all languages, and goes with it where there is none."""
_INSTALL = phrase("Install it; “carpus doctor” says what and how.")
_STORED = phrase("Everything recorded so far is stored on this computer.")

FAULTS: dict[type[CarpusFault], Words] = {
    errors.RecordingMissing: Words(
        phrase("There is no recording at {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Check the name and the folder."),
    ),
    errors.RecordingUnreadable: Words(
        phrase("The recording cannot be read: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Copy the recording again from where it was made, or correct the list."),
    ),
    errors.RecordingEmpty: Words(
        phrase("The recording holds no picture: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Choose another recording, or record again."),
    ),
    errors.PictureDamaged: Words(
        phrase("A picture of the recording cannot be used: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Copy the recording again from where it was made; carpus track --leave-out-damaged goes on without it."),
    ),
    errors.PictureSizeChanged: Words(
        phrase("The pictures of the recording differ in size: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Use a recording whose pictures all have one size."),
    ),
    errors.TimesUnordered: Words(
        phrase("The times of the recording do not rise: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Put the list in the order of time with each time once, or record again."),
    ),
    errors.DepthMissing: Words(
        phrase("The recording has no usable depth: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Use a recording of colour and depth."),
    ),
    errors.CameraFileUnreadable: Words(
        phrase("The file of the camera cannot be used: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Calibrate the camera again, or take the file away to use the usual values."),
    ),
    errors.ClicksUnreadable: Words(
        phrase("The clicks cannot be read: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Correct the file, or click the markers again."),
    ),
    errors.ProtocolUnknown: Words(
        phrase("There is no set of markers with the name {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Use wrist6 or hand21."),
    ),
    errors.ClickOutsidePicture: Words(
        phrase("A click lies outside the picture: {subject} ({detail})."),
        _NOTHING_YET,
        phrase("Click the marker in the first picture of this recording."),
    ),
    errors.ClickOnNoMarker: Words(
        phrase("A click has no blue marker of its own: {subject}."),
        _NOTHING_YET,
        phrase("Click nearer to the marker, or check the light."),
    ),
    errors.MarkerWithoutDepth: Words(
        phrase("The camera measures no depth at a marker: {subject}."),
        _NOTHING_YET,
        phrase("Move the hand a little, and keep sunlight and shine off the markers."),
    ),
    errors.CalibrationImpossible: Words(
        phrase("The clicked markers do not make a hand ({subject})."),
        _NOTHING_YET,
        phrase("Click every marker again under its own name."),
    ),
    errors.OutputExists: Words(
        phrase("There is a file already at {subject}."),
        phrase("That file is untouched; Carpus never overwrites."),
        phrase("Choose another name."),
    ),
    errors.ExtraMissing: Words(
        phrase("This needs the Python package {subject}, which is not installed."),
        _UNTOUCHED,
        _INSTALL,
    ),
    errors.SchedulerUnreachable: Words(
        phrase("The scheduler at {subject} does not answer ({detail})."),
        _UNTOUCHED,
        phrase("Check the address, or leave out --scheduler to use this machine."),
    ),
    errors.OutputBusy: Words(
        phrase("Another program is making {subject} at this moment."),
        phrase("It is left to that program."),
        phrase("Wait until it has ended, or choose another folder."),
    ),
    errors.OutputNotWritable: Words(
        phrase("Carpus cannot write to {subject} ({detail})."),
        phrase("What was stored before is safe."),
        phrase("Check that the folder exists and that you may write there, or choose another one."),
    ),
    errors.DiskFull: Words(
        phrase("The disk has no room left for {subject} ({detail})."),
        phrase("Everything stored before is safe; at most the last second is missing."),
        phrase("Free some space, or choose another disk."),
    ),
    errors.DiskTooSlow: Words(
        phrase("The disk is too slow for the recording, so it has ended: {subject} ({detail})."),
        phrase("Everything stored up to then is safe."),
        phrase("Record to a disk inside this computer, and close other programs."),
    ),
    errors.NotLookedBack: Words(
        phrase("Carpus could not look back at the session: {subject} ({detail})."),
        phrase("All of it is stored as it was measured live."),
        phrase("Run “carpus track” on the session to look back at it."),
    ),
    errors.NotCorrectable: Words(
        phrase("The markers of this session cannot be corrected: {subject} ({detail})."),
        phrase("The session is unchanged, and its repetitions can be left out."),
        phrase("Leave out the repetitions that should not count, or track the recording again with “carpus track”."),
    ),
    errors.NotCorrected: Words(
        phrase("Tracking again stopped: {subject} ({detail})."),
        phrase("The old result is unchanged."),
        phrase("Try again, or correct another picture too."),
    ),
    errors.SessionUnreadable: Words(
        phrase("This session cannot be read: {subject} ({detail})."),
        phrase("The file is untouched, and all other sessions are safe."),
        phrase("Check that it is a session of this or an older Carpus, or take it from a backup."),
    ),
    errors.SessionChanged: Words(
        phrase("This session was changed after it was finished: {subject}."),
        phrase("It can still be read; its seal does not fit what it holds now."),
        phrase("Take it from a backup, or do not rely on its figures."),
    ),
    errors.SessionUnfinished: Words(
        phrase("This session is not finished: {subject}."),
        phrase("What was recorded of it is there."),
        phrase("Finish it with “carpus recover”, or wait until its recording has ended."),
    ),
    errors.ReferenceUnreadable: Words(
        phrase("The reference cannot be read: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Use C3D, TRC, MOT, a CSV table with its column map, or a session."),
    ),
    errors.ReferenceUnsuited: Words(
        phrase("Nothing in the reference can be compared: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Check that it is the same movement, and say which column or marker is which."),
    ),
    errors.StudyUnsuited: Words(
        phrase("These sessions make no test and retest: {subject} ({detail})."),
        phrase("What counts as a change stays as it is."),
        phrase("Measure each person twice, discs put on anew, within 14 days; 10 people are the least."),
    ),
    errors.SettingsInvalid: Words(
        phrase("A setting cannot be used: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Correct the setting, or take it out to use the usual value."),
    ),
    errors.ChangedMeanwhile: Words(
        phrase("Somebody else has changed this meanwhile, so your change was not kept."),
        phrase("What the other person entered is kept."),
        phrase("Open it again, look at what stands there now, and enter your change once more."),
    ),
    errors.ChangeRefused: Words(
        phrase("The clinic’s server {subject} does not take a change ({detail})."),
        phrase("All other changes arrive; this computer shows what the server has."),
        phrase("Enter the change once more, or ask whoever looks after the server."),
    ),
    errors.PseudonymGiven: Words(
        phrase(
            "The name {subject} was given twice while the server was away: the second patient has ({detail}) behind it."
        ),
        phrase("All sessions of both patients are kept apart."),
        phrase("Change the name in the patient’s entry if another one is better."),
    ),
    errors.ServerGone: Words(
        phrase("The clinic’s server for records does not answer: {subject} ({detail})."),
        phrase("Measure as usual: patients are shown as last known, and what is new waits here and is delivered."),
        phrase("Nothing need be done; if it lasts, ask whoever looks after the server."),
    ),
    errors.NameUnsuited: Words(
        phrase("This cannot be a name: {detail} ({subject})."),
        _UNTOUCHED,
        phrase("Type the name by hand instead of pasting it."),
    ),
    errors.RegisterUnreadable: Words(
        phrase("The list of patients cannot be opened: {subject} ({detail})."),
        phrase("The session files are safe; the list can be made again from them, without the names."),
        phrase("Start Carpus again, or move the file away and let Carpus make a new list."),
    ),
    errors.RegisterBusy: Words(
        phrase("The window of Carpus, or another program, has the list of patients open: {subject} ({detail})."),
        phrase("Nothing has been changed, and nothing is lost."),
        phrase("Close Carpus first, then try again."),
    ),
    errors.RegisterDamaged: Words(
        phrase("The list of patients is damaged: {subject} ({detail})."),
        phrase("The session files are safe; the list can be made again from them, without the names."),
        phrase("Start Carpus again, or take the list from a backup."),
    ),
    errors.RegisterSetAside: Words(
        phrase("The list of patients was damaged ({detail}); a new one holds what could be read, and the sessions."),
        phrase(
            "All sessions are safe; names, notes and comments may be missing. The damaged list is kept as {subject}."
        ),
        phrase("Look through the list; restore it from a backup, or enter again what is missing."),
    ),
    errors.RegisterMissing: Words(
        phrase("There are sessions, but no list of patients ({subject}); Carpus has made one from the sessions."),
        phrase("All sessions are safe. If there was a list before, its names, notes and comments are gone."),
        phrase("Restore the list from a backup, or enter the names again."),
    ),
    errors.LogUnguarded: Words(
        phrase("What keeps the log of deeds from being changed had been taken out of {subject}; it is there again."),
        phrase("Patients and sessions are safe. Lines of the log may have been changed or taken out."),
        phrase("Compare the log with that of a backup."),
    ),
    errors.FilesSetApart: Words(
        phrase("{detail} among the sessions cannot be read and are set apart: {subject}."),
        phrase("They are untouched where they are, and all other sessions are safe."),
        phrase("Take them from a backup, or leave them; Carpus does not open them again."),
    ),
    errors.FolderGone: Words(
        phrase("The folder of the recording is gone: {subject} ({detail})."),
        phrase("What was stored before it went is there when it comes back."),
        phrase("Connect the disk or the network again, or choose another folder."),
    ),
    errors.DiskStalled: Words(
        phrase("The disk of {subject} has not answered for {detail}."),
        phrase("The recording goes on; what came since waits in memory."),
        phrase("Look at the disk or the network. If it stays silent, the recording goes on on this computer."),
    ),
    errors.EndStalled: Words(
        phrase("The recording could not be ended: the disk of {subject} does not answer."),
        phrase("Everything that was recorded is stored there."),
        phrase("Once the disk answers, start Carpus again: it finishes the recording."),
    ),
    errors.RecordingMoved: Words(
        phrase("The folder of the sessions is gone; the recording goes on in {subject} ({detail})."),
        phrase("All of it is safe on this computer."),
        phrase(
            "Go on; connect the disk or the network again later, and Carpus brings the session home when it starts."
        ),
    ),
    errors.RecordingReturned: Words(
        phrase("A session that was recorded while the folder of the sessions was away is there now: {subject}."),
        phrase("All of it is safe."),
        phrase("Review it as any other."),
    ),
    errors.FolderMissing: Words(
        phrase("There is no folder {subject}."),
        phrase("Nothing has been changed."),
        phrase("Name the folder that holds the sessions."),
    ),
    errors.FolderInUse: Words(
        phrase("Another Carpus is using the patients of {subject}."),
        phrase("Nothing has been changed."),
        phrase("Go to the window that is open already, or choose another folder."),
    ),
    errors.SessionsMissing: Words(
        phrase("There is no session in {subject}."),
        phrase("Nothing has been changed."),
        phrase("Measure one, or name the folder that holds the sessions."),
    ),
    errors.PatientUnknown: Words(
        phrase("There is no patient {subject} ({detail})."),
        phrase("Nothing has been changed."),
        phrase("Choose one of the patients that there are."),
    ),
    errors.PseudonymTaken: Words(
        phrase("The name {subject} belongs to another patient."),
        _UNTOUCHED,
        phrase("Choose another name."),
    ),
    errors.ErasureUnfinished: Words(
        phrase("Not all files could be deleted yet ({detail} left, such as {subject})."),
        phrase("They are in no list any more, and Carpus tries again whenever it starts."),
        phrase(
            "Close other programs that have them open, or allow Carpus to write in their folder, and start it again."
        ),
    ),
    errors.ErasureLeadsOut: Words(
        phrase("Nothing was erased: {subject} is a link that leads elsewhere."),
        phrase("Carpus deletes no file behind a link; everything is as it was."),
        phrase("Put what it leads to in its place, then erase again."),
    ),
    errors.BackupPlaceUnsuited: Words(
        phrase("Back-ups cannot lie there: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Choose a folder on another disk."),
    ),
    errors.BackupIncomplete: Words(
        phrase("The back-up lacks files: {subject} is missing or cannot be read; {detail} in all."),
        phrase("Everything else is in it."),
        phrase("Bring the folder of the sessions back or its disk, and back up again; or erase these sessions."),
    ),
    errors.PassphraseUnfit: Words(
        phrase("This passphrase cannot be taken: {detail}."),
        _UNTOUCHED,
        phrase("Choose {count} signs or more, best four words.", count=10),
    ),
    errors.SealRefused: Words(
        phrase("{subject} does not open: the passphrase is another one, or the file is damaged."),
        _UNTOUCHED,
        phrase("Type the passphrase again, capitals and blanks as they were."),
    ),
    errors.TooLargeToSeal: Words(
        phrase("This is too much to be sealed as one file: {detail} GB."),
        _UNTOUCHED,
        phrase("Back up to a folder on an encrypted disk, or seal single sessions."),
    ),
    errors.BackupUnequal: Words(
        phrase("The back-up is damaged: a content read back is not what was written ({subject}, {detail})."),
        phrase("The data on this computer are as they were."),
        phrase("Back up onto another disk now, and do not trust this one any more."),
    ),
    errors.BackupUnreadable: Words(
        phrase("The back-up cannot be read: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Choose another back-up, or bring Carpus up to date."),
    ),
    errors.BackupMissing: Words(
        phrase("There is no back-up in {subject}."),
        _UNTOUCHED,
        phrase("Choose the folder that holds the back-ups."),
    ),
    errors.BoardMissing: Words(
        phrase("The printed board is not to be seen: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Print it with carpus calibrate-camera --board, and hold all of it in the picture, in good light."),
    ),
    errors.BoardViewsAlike: Words(
        phrase("The pictures of the board are too few or too alike: {subject} ({detail})."),
        _UNTOUCHED,
        phrase(
            "Show the board in every part of the picture, tilted to all four sides, near and far, and hold it still."
        ),
    ),
    errors.BoardUnfit: Words(
        phrase("The corners do not fit a flat board: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Glue the board onto something stiff and flat, give it light, and hold it still."),
    ),
    errors.CardMissing: Words(
        phrase("The check card is not to be seen well enough: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Lay it flat under the camera, all of it in the picture, about 60 cm away, in good light."),
    ),
    errors.PinUncheckable: Words(
        phrase("The PIN cannot be checked: {subject} is missing on this computer ({detail})."),
        phrase("Nothing is lost; everything stays hidden."),
        phrase("Whoever looks after this computer installs Carpus again, with all its parts."),
    ),
    errors.DriverMissing: Words(
        phrase("The driver of the camera is not on this computer, or cannot be loaded ({detail})."),
        _UNTOUCHED,
        _INSTALL,
    ),
    errors.DriverFailed: Words(
        phrase("The driver of the camera has stopped: {subject} ({detail})."),
        _STORED,
        phrase("Unplug the camera, plug it in again and start once more."),
    ),
    errors.CameraUnknown: Words(
        phrase("No kind of camera is called {subject} ({detail})."),
        _NOTHING_YET,
        phrase("Choose the camera by one of these names, in the settings or with --camera."),
    ),
    errors.CameraMissing: Words(
        phrase("Carpus sees no camera ({detail})."),
        _NOTHING_YET,
        phrase("Plug the camera straight into the computer."),
    ),
    errors.CameraBusy: Words(
        phrase("Another program uses the camera ({detail})."),
        _NOTHING_YET,
        phrase("Close the other program, then try again."),
    ),
    errors.CameraPermission: Words(
        phrase("The camera is there, but you may not open it ({detail})."),
        _NOTHING_YET,
        phrase("Give yourself access to it; “carpus doctor” says how."),
    ),
    errors.CameraUnsuited: Words(
        phrase("This camera does not give the pictures that Carpus needs: {subject} ({detail})."),
        _STORED,
        phrase("Use a camera with colour and depth, such as the Xtion."),
    ),
    errors.CameraLost: Words(
        phrase("The camera sends no more pictures: {subject} ({detail})."),
        _STORED,
        phrase("Plug the camera in again; tracking and recording then go on by themselves."),
    ),
    errors.OtherCamera: Words(
        phrase("Carpus waits for its camera: {subject}. Another one is there ({detail})."),
        _STORED,
        phrase("Plug its own camera in again; what was begun then goes on by itself."),
    ),
    errors.CameraReturned: Words(
        phrase("The camera is back: {subject} (away for {detail})."),
        _STORED,
        phrase("Go on; the pause is marked in the session."),
    ),
    errors.RecordingDamaged: Words(
        phrase("The recording is damaged: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Copy the recording again from where it was made."),
    ),
    errors.RecordingUnsupported: Words(
        phrase("Carpus cannot use the pictures of this recording: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Record again with colour and depth of one size."),
    ),
    errors.PicturesLost: Words(
        phrase("Damaged pictures of the recording are left out: {subject} ({detail})."),
        phrase("All other pictures are used, and the gaps are marked."),
        phrase("Copy the recording again if there are many."),
    ),
    errors.PicturesEnlarged: Words(
        phrase("Some pictures are smaller and have been enlarged: {subject} ({detail})."),
        _UNTOUCHED,
        phrase("Set colour and depth to one size next time."),
    ),
    errors.IntrinsicsAssumed: Words(
        phrase(
            "There is no file of the camera with {subject}; Carpus uses {detail}, and lengths may be several "
            "per cent off."
        ),
        _UNTOUCHED,
        phrase("Put the camera_info.yaml of the camera beside it."),
    ),
    errors.RegistrationAssumed: Words(
        phrase("Nothing says whether depth lies on colour in {subject}; Carpus takes it so."),
        _UNTOUCHED,
        phrase("Write “registered: true” or “false” into its camera_info.yaml."),
    ),
    errors.DepthNotRegistered: Words(
        phrase("Depth does not lie on colour in {subject}, so depths are less sure."),
        _UNTOUCHED,
        phrase("Switch on registration in the camera next time."),
    ),
}
"""Words with places for the facts; every kind of fault has its own entry."""

_ABOUT_MARKERS = (
    errors.ClickOutsidePicture,
    errors.ClickOnNoMarker,
    errors.MarkerWithoutDepth,
    errors.CalibrationImpossible,
)

FINDINGS: dict[str, FindingWords] = {
    "click_on_no_marker": FindingWords(
        phrase("No blue marker at the {markers}."),
        phrase("Click nearer to the marker, or check the light."),
    ),
    "two_clicks_on_one": FindingWords(
        phrase("The clicks for the {markers} are on one marker."),
        phrase("Click each of the two on its own marker."),
    ),
    "swapped": FindingWords(
        phrase("{markers} look swapped."),
        phrase("Swap the two names, or click both markers again."),
    ),
    "misnamed": FindingWords(
        phrase("The {markers} does not lie on the line of its finger."),
        phrase("Look at the lines on the picture, and give the marker its right name."),
    ),
    "shifted": FindingWords(
        phrase("The names look shifted: the marker clicked as {first} is the {second}."),
        phrase("Click all markers again, each under its own name."),
    ),
    "wrong_side": FindingWords(
        phrase("This looks like the other hand."),
        phrase("Choose the other side, or click the markers again."),
    ),
    "no_depth": FindingWords(
        phrase("The camera measures no depth at the {markers}."),
        phrase("Move the hand a little, and keep sunlight and shine off the marker."),
    ),
    "residual": FindingWords(
        phrase("The marker of the {markers} is {value} mm off its place (up to {limit} mm is good)."),
        phrase("Click it again in its middle, and keep the hand still."),
    ),
    "hand_length": FindingWords(
        phrase("The hand measures {value} mm ({limit} mm is the limit)."),
        phrase("Check that every marker is clicked under its own name."),
    ),
    "other_spot": FindingWords(
        phrase("Another blue spot fits the {markers} better."),
        phrase("Take the spot with the question mark, if it is the disc."),
    ),
    "spare_spot": FindingWords(
        phrase("There is one more blue spot on the hand than there are names."),
        phrase("Cover the spot with the question mark, or give it its name."),
    ),
    "near_spot": FindingWords(
        phrase("Another blue spot lies close to the {markers}: it may be the disc."),
        phrase("Click the {markers} again in its middle, or cover the other spot."),
    ),
    "no_palm": FindingWords(
        phrase("No hand has this shape: the {markers} does not lie where the other discs expect it."),
        phrase("Check that a disc was clicked there, and not another blue spot."),
    ),
    "other_length": FindingWords(
        phrase("The hand measures {value} mm, and {limit} mm last time."),
        phrase("Check the patient, the side, and that every marker is clicked under its own name."),
    ),
    "tilt": FindingWords(
        phrase("The hand is tilted {value}° to the camera (up to {limit}° is good)."),
        phrase("Turn the back of the hand to the camera."),
    ),
    "distance": FindingWords(
        phrase("The hand is {value} m from the camera ({limit} m or more is good)."),
        phrase("Move the camera further from the hand."),
    ),
    "moved": FindingWords(
        phrase("The hand moved in the first half second."),
        phrase("Keep the hand still and take the first picture again."),
    ),
    "few_frames": FindingWords(
        phrase("The hand was still for {value} pictures only ({limit} or more are good)."),
        phrase("Keep the hand still for half a second."),
    ),
    "depth_off": FindingWords(
        phrase("Depth and colour do not lie on each other at the {markers} ({value} {unit}, up to {limit} is good)."),
        phrase("Switch on registration in the camera, or track without depth."),
    ),
}
"""Words for every kind of :class:`core.calibration.result.Finding`."""

_FINGERS = {
    "1": phrase("thumb"), "2": phrase("index finger"), "3": phrase("middle finger"), "4": phrase("ring finger"),
    "5": phrase("little finger"),
}  # fmt: skip

MARKERS: dict[str, Phrase] = {
    "WRIST": phrase("wrist"),
    "CMC1": phrase("thumb base"),
    "MCP1": phrase("thumb knuckle"),
    "IP1": phrase("thumb end joint"),
    "TIP1": phrase("thumb tip"),
    "MCP2": phrase("index knuckle"),
    "PIP2": phrase("index finger middle joint"),
    "DIP2": phrase("index finger end joint"),
    "TIP2": phrase("index tip"),
    "MCP3": phrase("middle knuckle"),
    "PIP3": phrase("middle finger middle joint"),
    "DIP3": phrase("middle finger end joint"),
    "TIP3": phrase("middle tip"),
    "MCP4": phrase("ring knuckle"),
    "PIP4": phrase("ring finger middle joint"),
    "DIP4": phrase("ring finger end joint"),
    "TIP4": phrase("ring tip"),
    "MCP5": phrase("little knuckle"),
    "PIP5": phrase("little finger middle joint"),
    "DIP5": phrase("little finger end joint"),
    "TIP5": phrase("little tip"),
}
"""Clinical name of every marker."""


def words_of(fault: CarpusFault, *, marker_names: bool = False, say: Say = str) -> Words:
    """The three answers for this fault; ``marker_names`` adds the markers' names of the files to the clinical ones;
    ``say`` says a phrase in another language."""
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = markers_in_words(subject.split(", "), say)
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    template, detail = FAULTS[type(fault)], say(fault.detail)
    said = [_filled(say(text), subject, detail) for text in (template.happened, template.safe, template.do)]
    if isinstance(fault, errors.ExtraMissing) and subject:
        said[2] = say(how_to_install(subject))
    return Words(*said)


def one_sentence(fault: CarpusFault) -> str:
    """One line for the command line: what happened, with which file, and what to do."""
    words = words_of(fault, marker_names=True)
    return _joined(words.happened, words.do)


def finding_words(finding: Finding, say: Say = str, written: Callable[[float], str] = "{:.3g}".format) -> FindingWords:
    """Headline and remedy of a finding; ``say`` says a phrase in another language, ``written`` writes its figures."""
    template = FINDINGS[finding.kind]
    headline = say(template.headline)
    if math.isnan(finding.value) and " (" in headline:
        headline = headline[: headline.index(" (")] + "."
    text = headline.format(
        markers=_exchanged_in_words(finding, say) or markers_in_words(finding.markers, say) or say(_HAND),
        first=marker_in_words(finding.markers[0], say) if finding.markers else "",
        second=marker_in_words(finding.markers[1], say) if len(finding.markers) > 1 else "",
        value=written(finding.value),
        limit=written(finding.limit),
        unit=finding.unit,
    )
    return FindingWords(text[0].upper() + text[1:], say(template.remedy))


def _exchanged_in_words(finding: Finding, say: Say) -> str:
    """``middle finger and ring finger`` where all names of two fingers stand in for each other."""
    if finding.kind != "swapped" or len(finding.markers) <= 2:
        return ""
    firsts = (finding.markers[0], finding.markers[len(finding.markers) // 2])
    return say(phrase("{one} and {other}", one=_FINGERS[firsts[0][-1]], other=_FINGERS[firsts[1][-1]]))


def finding_sentence(finding: Finding) -> str:
    """Headline and remedy on one line."""
    words = finding_words(finding)
    return _joined(words.headline, words.remedy)


def marker_in_words(marker: str, say: Say = str) -> str:
    """Clinical name of a marker; any other name stays.

    >>> marker_in_words("MCP2"), marker_in_words("CMC1"), marker_in_words("PIP5")
    ('index knuckle', 'thumb base', 'little finger middle joint')
    """
    return say(MARKERS[marker]) if marker in MARKERS else marker


def markers_in_words(markers: list[str] | tuple[str, ...], say: Say = str) -> str:
    """Several markers as a person says them.

    >>> markers_in_words(("MCP2", "MCP3")), markers_in_words(("WRIST", "CMC1", "MCP4"))
    ('index and middle knuckle', 'wrist, thumb base and ring knuckle')
    """
    names = [marker_in_words(marker, say) for marker in markers]
    if len(names) > 1 and all(name.endswith(" knuckle") for name in names):  # as one says it in English
        names = [*(name.removesuffix(" knuckle") for name in names[:-1]), names[-1]]
    if len(names) < 2:
        return "".join(names)
    return say(phrase("{one} and {other}", one=", ".join(names[:-1]), other=names[-1]))


def _filled(text: str, subject: str, detail: str) -> str:
    """Put the facts in their places; a place without a fact goes, with what binds it to the sentence."""
    facts = {"subject": subject, "detail": " ".join(detail.split())}
    for name, fact in facts.items():
        if not fact:
            text = re.sub(rf" \([^()]*\{{{name}\}}\)|(: |{_BINDING}| )\{{{name}\}}", "", text)
    return text.format(**facts)


def _joined(happened: str, do: str) -> str:
    return f"{happened.removesuffix('.')}; {do[0].lower()}{do[1:]}"
