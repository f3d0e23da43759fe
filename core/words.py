"""The one place that speaks of faults: for each kind what happened, whether the data are safe, and what to do.

Short main clauses in the present tense; the program is Carpus, the person is not blamed. ``{subject}`` and
``{detail}`` are the facts of the fault. The texts are plain English; a window may translate them before filling.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from carpus.core import errors
from carpus.core.calibration.result import Finding
from carpus.core.errors import CarpusFault
from carpus.core.hand.sites import SITES


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


_UNTOUCHED = "Nothing has been changed, and nothing is lost."
_NOTHING_YET = "Nothing has been recorded, so nothing is lost."
_STORED = "Everything recorded so far is stored on this computer."

FAULTS: dict[type[CarpusFault], Words] = {
    errors.RecordingMissing: Words(
        "There is no recording at {subject}.",
        _UNTOUCHED,
        "Check the name and the folder.",
    ),
    errors.RecordingUnreadable: Words(
        "The recording cannot be read: {subject} ({detail}).",
        _UNTOUCHED,
        "Copy the recording again from where it was made, or correct the list.",
    ),
    errors.RecordingEmpty: Words(
        "The recording holds no picture: {subject} ({detail}).",
        _UNTOUCHED,
        "Choose another recording, or record again.",
    ),
    errors.PictureDamaged: Words(
        "A picture of the recording cannot be used: {subject} ({detail}).",
        _UNTOUCHED,
        "Copy the recording again from where it was made; carpus track --leave-out-damaged goes on without it.",
    ),
    errors.PictureSizeChanged: Words(
        "The pictures of the recording differ in size: {subject} ({detail}).",
        _UNTOUCHED,
        "Use a recording whose pictures all have one size.",
    ),
    errors.TimesUnordered: Words(
        "The times of the recording do not rise: {subject} ({detail}).",
        _UNTOUCHED,
        "Put the list in the order of time with each time once, or record again.",
    ),
    errors.DepthMissing: Words(
        "The recording has no usable depth: {subject} ({detail}).",
        _UNTOUCHED,
        "Use a recording of colour and depth.",
    ),
    errors.CameraFileUnreadable: Words(
        "The file of the camera cannot be used: {subject} ({detail}).",
        _UNTOUCHED,
        "Calibrate the camera again, or take the file away to use the usual values.",
    ),
    errors.ClicksUnreadable: Words(
        "The clicks cannot be read: {subject} ({detail}).",
        _UNTOUCHED,
        "Correct the file, or click the markers again.",
    ),
    errors.ProtocolUnknown: Words(
        "There is no set of markers with the name {subject} ({detail}).",
        _UNTOUCHED,
        "Use wrist6 or hand21.",
    ),
    errors.ClickOutsidePicture: Words(
        "A click lies outside the picture: {subject} ({detail}).",
        _NOTHING_YET,
        "Click the marker in the first picture of this recording.",
    ),
    errors.ClickOnNoMarker: Words(
        "A click has no blue marker of its own: {subject}.",
        _NOTHING_YET,
        "Click nearer to the marker, or check the light.",
    ),
    errors.MarkerWithoutDepth: Words(
        "The camera measures no depth at a marker: {subject}.",
        _NOTHING_YET,
        "Move the hand a little, and keep sunlight and shine off the markers.",
    ),
    errors.CalibrationImpossible: Words(
        "The clicked markers do not make a hand ({subject}).",
        _NOTHING_YET,
        "Click every marker again under its own name.",
    ),
    errors.OutputExists: Words(
        "There is a file already at {subject}.",
        "That file is untouched; Carpus never overwrites.",
        "Choose another name.",
    ),
    errors.ExtraMissing: Words(
        "This needs carpus[{subject}] ({detail}), which is not installed.",
        _UNTOUCHED,
        "Install it with pip.",
    ),
    errors.SchedulerUnreachable: Words(
        "The scheduler at {subject} does not answer ({detail}).",
        _UNTOUCHED,
        "Check the address, or leave out --scheduler to use this machine.",
    ),
    errors.OutputBusy: Words(
        "Another program is making {subject} at this moment.",
        "It is left to that program.",
        "Wait until it has ended, or choose another folder.",
    ),
    errors.OutputNotWritable: Words(
        "Carpus cannot write to {subject} ({detail}).",
        "What was stored before is safe.",
        "Check that the folder exists and that you may write there, or choose another one.",
    ),
    errors.DiskFull: Words(
        "The disk has no room left for {subject} ({detail}).",
        "Everything stored before is safe; at most the last second is missing.",
        "Free some space, or choose another disk.",
    ),
    errors.DiskTooSlow: Words(
        "The disk is too slow for the recording, so it has ended: {subject} ({detail}).",
        "Everything stored up to then is safe.",
        "Record to a disk inside this computer, and close other programs.",
    ),
    errors.NotLookedBack: Words(
        "Carpus could not look back at the session: {subject} ({detail}).",
        "All of it is stored as it was measured live.",
        "Run “carpus track” on the session to look back at it.",
    ),
    errors.NotCorrectable: Words(
        "The markers of this session cannot be corrected: {subject} ({detail}).",
        "The session is unchanged, and its repetitions can be left out.",
        "Leave out the repetitions that should not count, or track the recording again with “carpus track”.",
    ),
    errors.NotCorrected: Words(
        "Tracking again stopped: {subject} ({detail}).",
        "The old result is unchanged.",
        "Try again, or correct another picture too.",
    ),
    errors.SessionUnreadable: Words(
        "This session cannot be read: {subject} ({detail}).",
        "The file is untouched, and all other sessions are safe.",
        "Check that it is a session of this or an older Carpus, or take it from a backup.",
    ),
    errors.SessionChanged: Words(
        "This session was changed after it was finished: {subject}.",
        "It can still be read; its seal does not fit what it holds now.",
        "Take it from a backup, or do not rely on its figures.",
    ),
    errors.SessionUnfinished: Words(
        "This session is not finished: {subject}.",
        "What was recorded of it is there.",
        "Finish it with “carpus recover”, or wait until its recording has ended.",
    ),
    errors.ReferenceUnreadable: Words(
        "The reference cannot be read: {subject} ({detail}).",
        _UNTOUCHED,
        "Use C3D, TRC, MOT, a CSV table with its column map, or a session.",
    ),
    errors.ReferenceUnsuited: Words(
        "Nothing in the reference can be compared: {subject} ({detail}).",
        _UNTOUCHED,
        "Check that it is the same movement, and say which column or marker is which.",
    ),
    errors.StudyUnsuited: Words(
        "These sessions make no test and retest: {subject} ({detail}).",
        "What counts as a change stays as it is.",
        "Measure each person twice, discs put on anew, within 14 days; 10 people are the least.",
    ),
    errors.SettingsInvalid: Words(
        "A setting cannot be used: {subject} ({detail}).",
        _UNTOUCHED,
        "Correct the setting, or take it out to use the usual value.",
    ),
    errors.SetsUnreadable: Words(
        "The sets of exercises cannot be read: {subject} ({detail}).",
        _UNTOUCHED,
        "Single exercises can be measured as ever. Put a copy of the file back, or make the sets anew.",
    ),
    errors.RegisterUnreadable: Words(
        "The list of patients cannot be opened: {subject} ({detail}).",
        "The session files are safe; the list can be made again from them, without the names.",
        "Start Carpus again, or move the file away and let Carpus make a new list.",
    ),
    errors.RegisterDamaged: Words(
        "The list of patients is damaged: {subject} ({detail}).",
        "The session files are safe; the list can be made again from them, without the names.",
        "Start Carpus again, or take the list from a backup.",
    ),
    errors.RegisterSetAside: Words(
        "The list of patients was damaged ({detail}), so Carpus has made a new one from the sessions.",
        "All sessions are safe; names and notes are missing. The damaged list is kept as {subject}.",
        "Restore the list from a backup, or enter the names again.",
    ),
    errors.FilesSetApart: Words(
        "{detail} among the sessions cannot be read and are set apart: {subject}.",
        "They are untouched where they are, and all other sessions are safe.",
        "Take them from a backup, or leave them; Carpus does not open them again.",
    ),
    errors.FolderGone: Words(
        "The folder of the recording is gone: {subject} ({detail}).",
        "What was stored before it went is there when it comes back.",
        "Connect the disk or the network again, or choose another folder.",
    ),
    errors.DiskStalled: Words(
        "The disk of {subject} has not answered for {detail}.",
        "The recording goes on; what came since waits in memory.",
        "Look at the disk or the network. If it stays silent, the recording goes on on this computer.",
    ),
    errors.EndStalled: Words(
        "The recording could not be ended: the disk of {subject} does not answer.",
        "Everything that was recorded is stored there.",
        "Once the disk answers, start Carpus again: it finishes the recording.",
    ),
    errors.RecordingMoved: Words(
        "The folder of the sessions is gone; the recording goes on in {subject} ({detail}).",
        "All of it is safe on this computer.",
        "Go on; connect the disk or the network again later, and Carpus brings the session home when it starts.",
    ),
    errors.RecordingReturned: Words(
        "A session that was recorded while the folder of the sessions was away is there now: {subject}.",
        "All of it is safe.",
        "Review it as any other.",
    ),
    errors.FolderMissing: Words(
        "There is no folder {subject}.",
        "Nothing has been changed.",
        "Name the folder that holds the sessions.",
    ),
    errors.FolderInUse: Words(
        "Another Carpus is using the patients of {subject}.",
        "Nothing has been changed.",
        "Go to the window that is open already, or choose another folder.",
    ),
    errors.EncryptionMissing: Words(
        "The part of Carpus that encrypts is not installed here ({detail}).",
        "Nothing has been changed.",
        "Install Carpus anew, with the Python package sqlcipher3.",
    ),
    errors.FolderLocked: Words(
        "{subject} is encrypted, and its PIN has not been given.",
        "Nothing has been changed.",
        "Type the PIN when asked, or set CARPUS_PIN to it.",
    ),
    errors.KeyRefused: Words(
        "This is not the PIN of {subject}, and not its recovery code.",
        "Nothing has been changed.",
        "Try again; if the PIN is right, bring the key files (encryption…) back from a back-up.",
    ),
    errors.ContentDamaged: Words(
        "An encrypted file cannot be read: {subject} ({detail}).",
        "All other files are as they were.",
        "Bring it back from a back-up.",
    ),
    errors.ContentUnequal: Words(
        "{subject} could not be exchanged: what was read back is not what was written.",
        "The file is as it was.",
        "Check this computer’s disk, and back up.",
    ),
    errors.EncryptionUnfinished: Words(
        "Not every file could be encrypted or decrypted: {subject}, {detail} in all.",
        "These are as they were, and the key is kept.",
        "See to the disk or bring them back from a back-up; Carpus goes on with them at its next start.",
    ),
    errors.PseudonymTaken: Words(
        "The name {subject} belongs to another patient.",
        _UNTOUCHED,
        "Choose another name.",
    ),
    errors.ErasureUnfinished: Words(
        "Not all files could be deleted yet ({detail} left, such as {subject}).",
        "They are in no list any more, and Carpus tries again whenever it starts.",
        "Close other programs that have them open, or allow Carpus to write in their folder, and start it again.",
    ),
    errors.BackupPlaceUnsuited: Words(
        "Back-ups cannot lie there: {subject} ({detail}).",
        _UNTOUCHED,
        "Choose a folder on another disk.",
    ),
    errors.BackupUnequal: Words(
        "The back-up is damaged: a content read back is not what was written ({subject}, {detail}).",
        "The data on this computer are as they were.",
        "Back up onto another disk now, and do not trust this one any more.",
    ),
    errors.BackupUnreadable: Words(
        "The back-up cannot be read: {subject} ({detail}).",
        _UNTOUCHED,
        "Choose another back-up, or bring Carpus up to date.",
    ),
    errors.BackupMissing: Words(
        "There is no back-up in {subject}.",
        _UNTOUCHED,
        "Choose the folder that holds the back-ups.",
    ),
    errors.BoardMissing: Words(
        "The printed board is not to be seen: {subject} ({detail}).",
        _UNTOUCHED,
        "Print it with carpus calibrate-camera --board, and hold all of it in the picture, in good light.",
    ),
    errors.BoardViewsAlike: Words(
        "The pictures of the board are too few or too alike: {subject} ({detail}).",
        _UNTOUCHED,
        "Show the board in every part of the picture, tilted to all four sides, near and far, and hold it still.",
    ),
    errors.BoardUnfit: Words(
        "The corners do not fit a flat board: {subject} ({detail}).",
        _UNTOUCHED,
        "Glue the board onto something stiff and flat, give it light, and hold it still.",
    ),
    errors.CardMissing: Words(
        "The check card is not to be seen well enough: {subject} ({detail}).",
        _UNTOUCHED,
        "Lay it flat under the camera, all of it in the picture, about 60 cm away, in good light.",
    ),
    errors.CameraNameless: Words(
        "The camera does not say its number: {subject}.",
        "Nothing was kept; what was measured before stays.",
        "Check it by “carpus check-card --serial NUMBER” with the number printed on it.",
    ),
    errors.PinUncheckable: Words(
        "The PIN cannot be checked: {subject} is missing on this computer ({detail}).",
        "Nothing is lost; everything stays hidden.",
        "Whoever looks after this computer installs Carpus again, with all its parts.",
    ),
    errors.DriverMissing: Words(
        "The driver of the camera is not on this computer, or cannot be loaded ({detail}).",
        _UNTOUCHED,
        "Install it; “carpus doctor” says what and how.",
    ),
    errors.DriverFailed: Words(
        "The driver of the camera has stopped: {subject} ({detail}).",
        _STORED,
        "Unplug the camera, plug it in again and start once more.",
    ),
    errors.CameraMissing: Words(
        "Carpus sees no camera ({detail}).",
        _NOTHING_YET,
        "Plug the camera straight into the computer.",
    ),
    errors.CameraBusy: Words(
        "Another program uses the camera ({detail}).",
        _NOTHING_YET,
        "Close the other program, then try again.",
    ),
    errors.CameraPermission: Words(
        "The camera is there, but you may not open it ({detail}).",
        _NOTHING_YET,
        "Give yourself access to it; “carpus doctor” says how.",
    ),
    errors.CameraUnsuited: Words(
        "This camera does not give the pictures that Carpus needs: {subject} ({detail}).",
        _STORED,
        "Use a camera with colour and depth, such as the Xtion.",
    ),
    errors.CameraLost: Words(
        "The camera sends no more pictures: {subject} ({detail}).",
        _STORED,
        "Plug the camera in again; tracking and recording then go on by themselves.",
    ),
    errors.OtherCamera: Words(
        "Carpus waits for its camera: {subject}. Another one is there ({detail}).",
        _STORED,
        "Plug its own camera in again; what was begun then goes on by itself.",
    ),
    errors.CameraReturned: Words(
        "The camera is back: {subject} (away for {detail}).",
        _STORED,
        "Go on; the pause is marked in the session.",
    ),
    errors.RecordingDamaged: Words(
        "The recording is damaged: {subject} ({detail}).",
        _UNTOUCHED,
        "Copy the recording again from where it was made.",
    ),
    errors.RecordingUnsupported: Words(
        "Carpus cannot use the pictures of this recording: {subject} ({detail}).",
        _UNTOUCHED,
        "Record again with colour and depth of one size.",
    ),
    errors.PicturesLost: Words(
        "Damaged pictures of the recording are left out: {subject} ({detail}).",
        "All other pictures are used, and the gaps are marked.",
        "Copy the recording again if there are many.",
    ),
    errors.PicturesEnlarged: Words(
        "Some pictures are smaller and have been enlarged: {subject} ({detail}).",
        _UNTOUCHED,
        "Set colour and depth to one size next time.",
    ),
    errors.IntrinsicsAssumed: Words(
        "There is no file of the camera with {subject}; Carpus uses {detail}, and lengths may be several per cent off.",
        _UNTOUCHED,
        "Put the camera_info.yaml of the camera beside it.",
    ),
    errors.RegistrationAssumed: Words(
        "Nothing says whether depth lies on colour in {subject}; Carpus takes it so.",
        _UNTOUCHED,
        "Write “registered: true” or “false” into its camera_info.yaml.",
    ),
    errors.DepthNotRegistered: Words(
        "Depth does not lie on colour in {subject}, so depths are less sure.",
        _UNTOUCHED,
        "Switch on registration in the camera next time.",
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
        "No blue marker at the {markers}.",
        "Click nearer to the marker, or check the light.",
    ),
    "two_clicks_on_one": FindingWords(
        "The clicks for the {markers} are on one marker.",
        "Click each of the two on its own marker.",
    ),
    "swapped": FindingWords(
        "{markers} look swapped.",
        "Swap the two names, or click both markers again.",
    ),
    "misnamed": FindingWords(
        "The {markers} does not lie on the line of its finger.",
        "Look at the lines on the picture, and give the marker its right name.",
    ),
    "shifted": FindingWords(
        "The names look shifted: the marker clicked as {first} is the {second}.",
        "Click all markers again, each under its own name.",
    ),
    "wrong_side": FindingWords(
        "This looks like the other hand.",
        "Choose the other side, or click the markers again.",
    ),
    "no_depth": FindingWords(
        "The camera measures no depth at the {markers}.",
        "Move the hand a little, and keep sunlight and shine off the marker.",
    ),
    "residual": FindingWords(
        "The marker of the {markers} is {value} mm off its place (up to {limit} mm is good).",
        "Click it again in its middle, and keep the hand still.",
    ),
    "hand_length": FindingWords(
        "The hand measures {value} mm ({limit} mm is the limit).",
        "Check that every marker is clicked under its own name.",
    ),
    "other_spot": FindingWords(
        "Another blue spot fits the {markers} better.",
        "Take the spot with the question mark, if it is the disc.",
    ),
    "spare_spot": FindingWords(
        "There is one more blue spot on the hand than there are names.",
        "Cover the spot with the question mark, or give it its name.",
    ),
    "no_palm": FindingWords(
        "No hand has this shape: the {markers} does not lie where the other discs expect it.",
        "Check that a disc was clicked there, and not another blue spot.",
    ),
    "other_length": FindingWords(
        "The hand measures {value} mm, and {limit} mm last time.",
        "Check the patient, the side, and that every marker is clicked under its own name.",
    ),
    "tilt": FindingWords(
        "The hand is tilted {value}° to the camera (up to {limit}° is good).",
        "Turn the back of the hand to the camera.",
    ),
    "distance": FindingWords(
        "The hand is {value} m from the camera ({limit} m or more is good).",
        "Move the camera further from the hand.",
    ),
    "moved": FindingWords(
        "The hand moved in the first half second.",
        "Keep the hand still and take the first picture again.",
    ),
    "few_frames": FindingWords(
        "The hand was still for {value} pictures only ({limit} or more are good).",
        "Keep the hand still for half a second.",
    ),
    "depth_off": FindingWords(
        "Depth and colour do not lie on each other at the {markers} ({value} {unit}, up to {limit} is good).",
        "Switch on registration in the camera, or track without depth.",
    ),
}
"""Words for every kind of :class:`core.calibration.result.Finding`."""

_FINGERS = {"1": "thumb", "2": "index", "3": "middle", "4": "ring", "5": "little"}
_JOINTS = {"MCP": "knuckle", "PIP": "middle joint", "DIP": "end joint", "IP": "end joint", "TIP": "tip"}


def words_of(fault: CarpusFault, *, marker_names: bool = False) -> Words:
    """The three answers for this fault; ``marker_names`` adds the markers' names of the files to the clinical ones."""
    subject = fault.subject
    if isinstance(fault, _ABOUT_MARKERS):
        spoken = markers_in_words(subject.split(", "))
        subject = f"{spoken}, {subject}" if marker_names and subject else spoken
    template = FAULTS[type(fault)]
    return Words(*(_filled(text, subject, fault.detail) for text in (template.happened, template.safe, template.do)))


def one_sentence(fault: CarpusFault) -> str:
    """One line for the command line: what happened, with which file, and what to do."""
    words = words_of(fault, marker_names=True)
    return _joined(words.happened, words.do)


def finding_words(finding: Finding) -> FindingWords:
    """Headline and remedy of a finding."""
    template = FINDINGS[finding.kind]
    headline = template.headline
    if math.isnan(finding.value) and " (" in headline:
        headline = headline[: headline.index(" (")] + "."
    text = headline.format(
        markers=_exchanged_in_words(finding) or markers_in_words(finding.markers) or "hand",
        first=marker_in_words(finding.markers[0]) if finding.markers else "",
        second=marker_in_words(finding.markers[1]) if len(finding.markers) > 1 else "",
        value=f"{finding.value:.3g}",
        limit=f"{finding.limit:.3g}",
        unit=finding.unit,
    )
    return FindingWords(text[0].upper() + text[1:], template.remedy)


def _exchanged_in_words(finding: Finding) -> str:
    """``middle finger and ring finger`` where all names of two fingers stand in for each other."""
    if finding.kind != "swapped" or len(finding.markers) <= 2:
        return ""
    firsts = (finding.markers[0], finding.markers[len(finding.markers) // 2])
    return " and ".join(f"{_FINGERS[name[-1]]} finger" for name in firsts)


def finding_sentence(finding: Finding) -> str:
    """Headline and remedy on one line."""
    words = finding_words(finding)
    return _joined(words.headline, words.remedy)


def marker_in_words(marker: str) -> str:
    """Clinical name of a marker; any other name stays.

    >>> marker_in_words("MCP2"), marker_in_words("CMC1"), marker_in_words("PIP5")
    ('index knuckle', 'thumb base', 'little finger middle joint')
    """
    if marker not in SITES:
        return marker
    if marker == "WRIST":
        return "wrist"
    if marker == "CMC1":
        return "thumb base"
    joint, finger = marker[:-1], _FINGERS[marker[-1]]
    if joint in ("PIP", "DIP"):
        finger += " finger"
    return f"{finger} {_JOINTS[joint]}"


def markers_in_words(markers: list[str] | tuple[str, ...]) -> str:
    """Several markers as a person says them.

    >>> markers_in_words(("MCP2", "MCP3")), markers_in_words(("WRIST", "CMC1", "MCP4"))
    ('index and middle knuckle', 'wrist, thumb base and ring knuckle')
    """
    names = [marker_in_words(marker) for marker in markers]
    if len(names) > 1 and all(marker in SITES and marker.startswith("MCP") for marker in markers):
        names = [*(name.removesuffix(" knuckle") for name in names[:-1]), names[-1]]
    return " and ".join(part for part in (", ".join(names[:-1]), *names[-1:]) if part)


def _filled(text: str, subject: str, detail: str) -> str:
    """Put the facts in their places; a place without a fact goes, with what binds it to the sentence."""
    facts = {"subject": subject, "detail": " ".join(detail.split())}
    for name, fact in facts.items():
        if not fact:
            text = re.sub(rf"(: | \((away for )?| (for|at|to|in) | )\{{{name}\}}\)?", "", text)
    return text.format(**facts)


def _joined(happened: str, do: str) -> str:
    return f"{happened.removesuffix('.')}; {do[0].lower()}{do[1:]}"
