"""What can go wrong: each kind of fault, and what is said of it; :mod:`core.words` puts the facts in. What ``happened``
is the class's own description; beside it stands only what it does not say.

Short main clauses in the present tense; the program is Carpus, the person is not blamed.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from carpus.core.phrase import Phrase, phrase

_UNCHANGED = phrase("Nothing has been changed.")
_FILE_UNCHANGED = phrase("The file was not changed.")
_RECORDING_UNCHANGED = phrase("The recording was not changed.")
_GOES_ON = phrase("The measurement goes on.")
_NOTHING_YET = phrase("Nothing has been recorded, so nothing is lost.")
_STORED = phrase("Everything recorded so far is stored on this computer.")
_INSTALL = phrase("Install it; “carpus doctor” says what and how.")


class CarpusFault(Exception):
    """Something the person at the desk must be told; an instance carries facts, its class the sentences.

    ``subject`` is the file, folder, device or marker concerned; ``detail`` the measured fact
    (a number, a name, a line), a :class:`Phrase` where it says more. Neither ever holds a patient's name.
    Each class states ``safe`` itself, and only what is known wherever it is raised: there is no default.
    ``happened``, whether the data are ``safe``, and what to ``do`` have places for ``{subject}`` and ``{detail}``.
    """

    happened: ClassVar[Phrase]
    safe: ClassVar[Phrase]
    do: ClassVar[Phrase]

    def __init__(self, subject: str | Path = "", detail: str = "") -> None:
        self.subject = str(subject)
        # A damaged file's own words may be no text; what is told must be storable and printable everywhere.
        storable = str(detail).encode("utf-8", "backslashreplace").decode("utf-8")
        self.detail = detail if isinstance(detail, Phrase) and detail == storable else storable
        super().__init__(f"{type(self).__name__}: {self.subject} {self.detail}".strip())


class RecordingMissing(CarpusFault):
    happened = phrase("There is no recording at {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Check the name and the folder.")


class RecordingUnreadable(CarpusFault):
    happened = phrase("The recording cannot be read: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Copy the recording again from where it was made, or correct the list.")


class RecordingEmpty(CarpusFault):
    happened = phrase("The recording holds no picture: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Choose another recording, or record again.")


class PictureDamaged(CarpusFault):
    happened = phrase("A picture of the recording cannot be used: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Copy the recording again from where it was made; carpus track --leave-out-damaged goes on without it.")


class FirstPictureDamaged(PictureDamaged):
    """The one on which the markers are clicked, without which nothing goes on."""

    happened = phrase("The first picture of the recording cannot be used: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Copy the recording again from where it was made.")


class PictureSizeChanged(CarpusFault):
    happened = phrase("The pictures of the recording differ in size: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Use a recording whose pictures all have one size.")


class TimesUnordered(CarpusFault):
    happened = phrase("The times of the recording do not rise: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Put the list in the order of time with each time once, or record again.")


class DepthMissing(CarpusFault):
    happened = phrase("The recording has no usable depth: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Use a recording of colour and depth.")


class CameraFileUnreadable(CarpusFault):
    happened = phrase("The file of the camera cannot be used: {subject} ({detail}).")
    safe = _FILE_UNCHANGED
    do = phrase("Calibrate the camera again, or correct the file.")


class ClicksUnreadable(CarpusFault):
    happened = phrase("The clicks cannot be read: {subject} ({detail}).")
    safe = _FILE_UNCHANGED
    do = phrase("Correct the file, or click the markers again.")


class ProtocolUnknown(CarpusFault):
    happened = phrase("There is no set of markers with the name {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Use wrist6 or hand21.")


class ClickOutsidePicture(CarpusFault):
    happened = phrase("A click lies outside the picture: {subject} ({detail}).")
    safe = _NOTHING_YET
    do = phrase("Click the marker in the first picture of this recording.")


class ClickOnNoMarker(CarpusFault):
    happened = phrase("A click has no blue marker of its own: {subject}.")
    safe = _NOTHING_YET
    do = phrase("Click nearer to the marker, or check the light.")


class MarkerWithoutDepth(CarpusFault):
    happened = phrase("The camera measures no depth at a marker: {subject}.")
    safe = _NOTHING_YET
    do = phrase("Move the hand a little, and keep sunlight and shine off the markers.")


class CalibrationImpossible(CarpusFault):
    happened = phrase("The clicked markers do not make a hand ({subject}).")
    safe = _NOTHING_YET
    do = phrase("Click every marker again under its own name.")


class OutputExists(CarpusFault):
    happened = phrase("There is a file already at {subject}.")
    safe = phrase("That file is untouched; Carpus never overwrites.")
    do = phrase("Choose another name.")


class ExtraMissing(CarpusFault):
    """A Python package that is installed only when asked for is not installed; ``subject`` is its name."""

    happened = phrase("This needs the Python package {subject}, which is not installed.")
    safe = _UNCHANGED
    do = _INSTALL


class NotCompiled(CarpusFault):
    """Modules of ``core/compiled`` that are there as source alone; ``subject`` names them."""

    happened = phrase("Carpus was not installed completely: a compiled part of it is missing ({subject}).")
    safe = _UNCHANGED
    do = phrase("Install Carpus anew.")


class SchedulerUnreachable(CarpusFault):
    happened = phrase("The scheduler at {subject} does not answer ({detail}).")
    safe = _UNCHANGED
    do = phrase("Check the address, or leave out --scheduler to use this machine.")


class OutputBusy(CarpusFault):
    happened = phrase("Another program is making {subject} at this moment.")
    safe = phrase("It is left to that program.")
    do = phrase("Wait until it has ended, or choose another folder.")


class OutputNotWritable(CarpusFault):
    happened = phrase("Carpus cannot write to {subject} ({detail}).")
    safe = phrase("What was stored before is safe.")
    do = phrase("Check that the folder exists and that you may write there, or choose another one.")


class DiskFull(CarpusFault):
    """No room was left while writing; what was written is kept."""

    happened = phrase("The disk has no room left for {subject} ({detail}).")
    safe = phrase("Everything stored before is safe. What was just being written may be missing.")
    do = phrase("Free some space, or choose another disk.")


class SessionUnreadable(CarpusFault):
    happened = phrase("This session cannot be read: {subject} ({detail}).")
    safe = phrase("The file is untouched, and all other sessions are safe.")
    do = phrase("Check that it is a session of this or an older Carpus, or take it from a back-up.")


class SessionMissing(SessionUnreadable):
    happened = phrase("File not found: {subject}.")
    safe = _UNCHANGED
    do = phrase("Check the path.")


class SessionChanged(CarpusFault):
    happened = phrase("This session was changed after it was finished: {subject}.")
    safe = phrase("It can still be read; its seal does not fit what it holds now.")
    do = phrase("Take it from a back-up, or do not rely on its figures.")


class SessionUnfinished(SessionUnreadable):
    """A part file of Carpus 0.2.0, which only its recovery reads."""

    happened = phrase("This session is not finished: {subject}.")
    safe = phrase("What was recorded of it is there.")
    do = phrase("Finish it with “carpus recover”, or wait until its recording has ended.")


class ReferenceUnreadable(CarpusFault):
    happened = phrase("The reference cannot be read: {subject} ({detail}).")
    safe = phrase("The session and the reference were not changed.")
    do = phrase("Use C3D, TRC, MOT, a CSV table with its column map, or a session.")


class ReferenceUnsuited(CarpusFault):
    happened = phrase("Nothing in the reference can be compared: {subject} ({detail}).")
    safe = phrase("The session and the reference were not changed.")
    do = phrase("Check that it is the same movement, and say which column or marker is which.")


class StudyUnsuited(CarpusFault):
    happened = phrase("These sessions make no test and retest: {subject} ({detail}).")
    safe = phrase("What counts as a change stays as it is.")
    do = phrase("Measure each person twice, discs put on anew, within 14 days; 10 people are the least.")


class SettingsInvalid(CarpusFault):
    happened = phrase("A setting cannot be used: {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Correct the setting, or take it out to use the usual value.")


class ChangedMeanwhile(CarpusFault):
    """Somebody else changed the same thing since it was read; ``subject`` is its table."""

    happened = phrase("Somebody else has changed this meanwhile, so your change was not kept.")
    safe = phrase("What the other person entered is kept.")
    do = phrase("Open it again, look at what stands there now, and enter your change once more.")


class PseudonymGiven(CarpusFault):
    """A pseudonym was given on two computers before they had one store; the number ``detail`` was put behind the second
    one."""

    happened = phrase("The name {subject} was given on two computers: the second patient has ({detail}) behind it.")
    safe = phrase("All sessions of both patients are kept apart.")
    do = phrase("Change the name in the patient’s entry if another one is better.")


class ServerGone(CarpusFault):
    """The clinic's server for records does not answer; nobody waits for it."""

    happened = phrase("The clinic’s server for records does not answer: {subject} ({detail}).")
    safe = phrase("All sessions are safe. What was being entered just now may not have been kept.")
    do = phrase(
        "Measure all the same, and enter the rest when the server answers; if it lasts, ask whoever looks after it."
    )


class NameUnsuited(CarpusFault):
    happened = phrase("This cannot be a name: {detail} ({subject}).")
    safe = _UNCHANGED
    do = phrase("Type the name by hand instead of pasting it.")


class DriverMissing(CarpusFault):
    happened = phrase("The driver of the camera is not on this computer, or cannot be loaded ({detail}).")
    safe = _UNCHANGED
    do = _INSTALL


class DriverFailed(CarpusFault):
    """The library of a camera died or no longer answers; it ran in a process of its own."""

    happened = phrase("The driver of the camera has stopped: {subject} ({detail}).")
    safe = _STORED
    do = phrase("Unplug the camera, plug it in again and start once more.")


class CameraUnknown(CarpusFault):
    happened = phrase("No kind of camera is called {subject} ({detail}).")
    safe = _NOTHING_YET
    do = phrase("Choose the camera by one of these names, in the settings or with --camera.")


class CameraMissing(CarpusFault):
    happened = phrase("Carpus sees no camera ({detail}).")
    safe = _NOTHING_YET
    do = phrase("Plug the camera straight into the computer.")


class CameraBusy(CarpusFault):
    happened = phrase("Another program uses the camera ({detail}).")
    safe = _NOTHING_YET
    do = phrase("Close the other program, then try again.")


class CameraPermission(CarpusFault):
    happened = phrase("The camera is there, but you may not open it ({detail}).")
    safe = _NOTHING_YET
    do = phrase("Give yourself access to it; “carpus doctor” says how.")


class CameraUnsuited(CarpusFault):
    happened = phrase("This camera does not give the pictures that Carpus needs: {subject} ({detail}).")
    safe = _STORED
    do = phrase("Use a camera with colour and depth, such as the Xtion.")


class CameraLost(CarpusFault):
    """The camera was unplugged or sends no more pictures. Told when it happens, raised when it does not come back."""

    happened = phrase("The camera sends no more pictures: {subject} ({detail}).")
    safe = _STORED
    do = phrase("Plug the camera in again; tracking and recording then go on by themselves.")


class OtherCamera(CameraLost):
    """Another camera is plugged in than the one that is wanted. Told while that one is away; raised at the opening."""

    happened = phrase("Carpus waits for its camera: {subject}. Another one is there ({detail}).")
    safe = _STORED
    do = phrase("Plug its own camera in again; what was begun then goes on by itself.")


class CameraReturned(CarpusFault):
    """Told, never raised: the lost camera delivers again; ``detail`` is how long it was away."""

    happened = phrase("The camera is back: {subject} (away for {detail}).")
    safe = _STORED
    do = phrase("Go on; the pause is marked in the session.")


class ExposureNotHeld(CarpusFault):
    """Told, never raised."""

    happened = phrase("The camera cannot hold its exposure: {subject}.")
    safe = _GOES_ON
    do = phrase("Keep the light as it is while you measure.")


class RecordingDamaged(CarpusFault):
    happened = phrase("The recording is damaged: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Copy the recording again from where it was made.")


class RecordingUnsupported(CarpusFault):
    happened = phrase("Carpus cannot use the pictures of this recording: {subject} ({detail}).")
    safe = _RECORDING_UNCHANGED
    do = phrase("Record again with colour and depth of one size.")


class PicturesLost(CarpusFault):
    """Told, never raised: damaged pictures of a recording were left out; ``detail`` counts them."""

    happened = phrase("Damaged pictures of the recording are left out: {subject} ({detail}).")
    safe = phrase("All other pictures are used, and the gaps are marked.")
    do = phrase("Copy the recording again if there are many.")


class PicturesEnlarged(CarpusFault):
    """Told, never raised: pictures of one kind were smaller and have been enlarged."""

    happened = phrase("Some pictures are smaller and have been enlarged: {subject} ({detail}).")
    safe = _GOES_ON
    do = phrase("Set colour and depth to one size next time.")


class IntrinsicsAssumed(CarpusFault):
    """Told, never raised: no camera file says how this camera sees, so ``detail`` is used in its place."""

    happened = phrase(
        "There is no file of the camera with {subject}; Carpus uses {detail}, and lengths may be several per cent off."
    )
    safe = _GOES_ON
    do = phrase("Put the camera_info.yaml of the camera beside it.")


class UnitAssumed(CarpusFault):
    """Told, never raised: the numbers of a recording make sense in another unit than its form has."""

    happened = phrase("By its numbers, the recording has {detail}, and Carpus reads it so: {subject}.")
    safe = _RECORDING_UNCHANGED
    do = phrase("If this is not so, correct the list, or state depth_unit_m in camera_info.yaml.")


class TimesTwice(CarpusFault):
    """Told, never raised: lines of a list with the time of the one before are left out; ``detail`` counts them."""

    happened = phrase("Pictures with the same time as the one before are left out: {subject} ({detail}).")
    safe = phrase("All other pictures are used, and the gaps are marked.")
    do = phrase("Record again if there are many.")


class RegistrationAssumed(CarpusFault):
    """Told, never raised: nothing says whether depth lies on colour; it is taken as so."""

    happened = phrase("Nothing says whether depth lies on colour in {subject}; Carpus takes it so.")
    safe = _GOES_ON
    do = phrase("Write “registered: true” or “false” into its camera_info.yaml.")


class DepthNotRegistered(CarpusFault):
    """Told, never raised: depth is known not to lie on colour, so depths are read beside the markers."""

    happened = phrase("Depth does not lie on colour in {subject}, so depths are less sure.")
    safe = _GOES_ON
    do = phrase("Switch on registration in the camera next time.")


class DiskTooSlow(CarpusFault):
    """Pictures came faster than they could be stored; what was stored is kept."""

    happened = phrase("The disk is too slow for the recording, so it has ended: {subject} ({detail}).")
    safe = phrase("Everything stored up to then is safe.")
    do = phrase("Record to a disk inside this computer, and close other programs.")


class NotLookedBack(CarpusFault):
    """Told, never raised to a person: looking back at a live session failed or took too long; it is as tracked."""

    happened = phrase("Carpus could not look back at the session: {subject} ({detail}).")
    safe = phrase("All of it is stored as it was measured live.")
    do = phrase("Run “carpus track” on the session to look back at it.")


class NotCorrectable(CarpusFault):
    happened = phrase("The markers of this session cannot be corrected: {subject} ({detail}).")
    safe = phrase("The session is unchanged, and its repetitions can be left out.")
    do = phrase("Leave out the repetitions that should not count, or track the recording again with “carpus track”.")


class NotCorrected(CarpusFault):
    """Tracking a session again with corrected markers did not come to its end; the old result is unchanged."""

    happened = phrase("Tracking again stopped: {subject} ({detail}).")
    safe = phrase("The old result is unchanged.")
    do = phrase("Try again, or correct another picture too.")


class RegisterUnreadable(CarpusFault):
    happened = phrase("The list of patients cannot be opened: {subject} ({detail}).")
    safe = phrase("The session files are not touched. Names and notes are in this file alone: keep it.")
    do = phrase("Start Carpus again. If that does not help, ask your IT support.")


class RegisterVersionUnknown(RegisterUnreadable):
    """A register of a newer Carpus, or one that says no version that there is."""

    happened = phrase("The list of patients is of another version of Carpus: {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Bring Carpus up to date on this computer.")


class RegisterBusy(RegisterUnreadable):
    happened = phrase("The window of Carpus, or another program, has the list of patients open: {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Close Carpus first, then try again.")


class RegisterJournalLeft(RegisterUnreadable):
    """Of a window that is open on another computer, or of one that ended without warning."""

    happened = phrase(
        "The last changes of the list of patients lie in its journal, "
        "which needs a folder that can be written: {subject}."
    )
    safe = _UNCHANGED
    do = phrase("Close Carpus wherever it is open; if that does not help, copy the folder to where it can be written.")


class RegisterDamaged(RegisterUnreadable):
    """The register's file is broken or not a register; reading it again does not help."""

    happened = phrase("The list of patients is damaged: {subject} ({detail}).")
    safe = RegisterUnreadable.safe
    do = phrase("Start Carpus again: it keeps what can still be read. If names are missing then, restore a back-up.")


class RegisterSetAside(CarpusFault):
    """Told, never raised: a damaged register was given another name, and the list made again from the sessions."""

    happened = phrase(
        "The list of patients was damaged ({detail}); a new one holds what could be read, and the sessions."
    )
    safe = phrase(
        "All sessions are safe; names, notes and comments may be missing. The damaged list is kept as {subject}."
    )
    do = phrase("Look through the list; restore it from a back-up, or enter again what is missing.")


class RegisterMissing(CarpusFault):
    """Told, never raised: there are sessions and no list of patients, so that one was made from them."""

    happened = phrase("There are sessions, but no list of patients ({subject}); Carpus has made one from the sessions.")
    safe = phrase("All sessions are safe. If there was a list before, its names, notes and comments are gone.")
    do = phrase("Restore the list from a back-up, or enter the names again.")


class LogUnguarded(CarpusFault):
    """Told, never raised: what keeps the log from being changed had been taken out of the store."""

    happened = phrase(
        "What keeps the log of deeds from being changed had been taken out of {subject}; it is there again."
    )
    safe = phrase("Patients and sessions are safe. Lines of the log may have been changed or taken out.")
    do = phrase("Compare the log with that of a back-up.")


class FilesSetApart(CarpusFault):
    """Told, never raised: files among the sessions that are none; ``subject`` names some, ``detail`` counts them."""

    happened = phrase("{detail} among the sessions cannot be read and are set apart: {subject}.")
    safe = phrase("They are untouched where they are, and all other sessions are safe.")
    do = phrase("Take them from a back-up, or leave them; Carpus does not open them again.")


class RecordingWaits(CarpusFault):
    """Told, never raised: a finished session waits at ``subject`` until the folder of the sessions can be reached."""

    happened = phrase("The folder of the sessions cannot be reached ({detail}); the session is kept in {subject}.")
    safe = phrase("All of it is safe on this computer.")
    do = phrase("Go on. Connect the disk or the network again; Carpus then moves the session by itself.")


class NothingRecorded(CarpusFault):
    """Told, never raised: a recording had ended before its first frame was stored."""

    happened = phrase("A recording ended before its first second was stored: {subject}. There is nothing to recover.")
    safe = phrase("Everything that was recorded before is safe.")
    do = phrase("Record this exercise again.")


class WaitingErased(CarpusFault):
    """Told, never raised: a recording that waited on this computer was of a patient who has been erased meanwhile."""

    happened = phrase(
        "A recording that waited on this computer was of a patient who has been erased: it is erased too."
    )
    safe = phrase("Nothing else has been changed.")
    do = phrase("Nothing need be done.")


class RecordingReturned(CarpusFault):
    """Told, never raised: a session that waited on this computer is among the others now."""

    happened = phrase("A session that waited on this computer is in the folder of the sessions now: {subject}.")
    safe = phrase("All of it is safe.")
    do = phrase("Review it as any other.")


class FolderMissing(CarpusFault):
    happened = phrase("There is no folder {subject}.")
    safe = _UNCHANGED
    do = phrase("Name the folder that holds the sessions.")


class ShareEmpty(FolderMissing):
    happened = phrase("There is nothing that Carpus made in the folder of the sessions: {subject}.")
    safe = phrase(
        "Nothing has been changed. What is recorded meanwhile stays on this computer until the share is there."
    )
    do = phrase("Is the share connected? Connect it; if the sessions were moved, copy them there.")


class NoDataFolder(CarpusFault):
    happened = phrase("There is nothing of Carpus in the folder {subject}.")
    safe = _UNCHANGED
    do = phrase("Name the folder that holds the patients; carpus doctor says which it is.")


class DataFolderChanged(CarpusFault):
    """Told at a start: ``subject`` is opened, ``detail`` is the folder of the start before, or of the settings."""

    happened = phrase("Carpus shows another data folder: {subject}.")
    safe = phrase("Before it was {detail}. Carpus has moved nothing out of it.")
    do = phrase("If patients are missing here, choose the data folder in Settings.")


class FolderInUse(CarpusFault):
    happened = phrase("Another Carpus is using the patients of {subject}.")
    safe = _UNCHANGED
    do = phrase("Go to the window that is open already, or choose another folder.")


class SessionsMissing(CarpusFault):
    happened = phrase("There is no session in {subject}.")
    safe = _UNCHANGED
    do = phrase("Measure one, or name the folder that holds the sessions.")


class PatientUnknown(CarpusFault):
    happened = phrase("There is no patient {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Choose one of the patients that there are.")


class PseudonymTaken(CarpusFault):
    happened = phrase("The name {subject} belongs to another patient.")
    safe = _UNCHANGED
    do = phrase("Choose another name.")


class ErasureUnfinished(CarpusFault):
    """Files of what was erased could not be deleted yet; ``subject`` names one, ``detail`` counts them."""

    happened = phrase("Not all files could be deleted yet ({detail} left, such as {subject}).")
    safe = phrase("They are in no list any more, and Carpus tries again whenever it starts.")
    do = phrase(
        "Close other programs that have them open, or allow Carpus to write in their folder, and start it again."
    )


class ErasureLeadsOut(CarpusFault):
    """Nothing was erased: ``subject`` is a link on the way to what should go."""

    happened = phrase("Nothing was erased: {subject} is a link that leads elsewhere.")
    safe = phrase("Carpus deletes no file behind a link; everything is as it was.")
    do = phrase("Put what it leads to in its place, then erase again.")


class BackupPlaceUnsuited(CarpusFault):
    happened = phrase("Back-ups cannot lie there: {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Choose a folder on another disk.")


class BackupIncomplete(CarpusFault):
    """Told after a back-up: ``subject`` is missing or cannot be read, and so are ``detail`` files in all."""

    happened = phrase("The back-up lacks files: {subject} is missing or cannot be read; {detail} in all.")
    safe = phrase("Everything else is in it.")
    do = phrase("Bring the session folder or its disk back, then back up again.")


class BackupUnequal(CarpusFault):
    """What is read back of a back-up is not what was written; ``subject`` begins the name of its content."""

    happened = phrase("The back-up is damaged: a content read back is not what was written ({subject}, {detail}).")
    safe = phrase("The data on this computer are as they were.")
    do = phrase("Back up onto another disk now, and do not trust this one any more.")


class BackupUnreadable(CarpusFault):
    happened = phrase("The back-up cannot be read: {subject} ({detail}).")
    safe = _FILE_UNCHANGED
    do = phrase("Choose another back-up, or bring Carpus up to date.")


class BackupMissing(CarpusFault):
    happened = phrase("There is no back-up in {subject}.")
    safe = _UNCHANGED
    do = phrase("Choose the folder that holds the back-ups.")


class BoardMissing(CarpusFault):
    happened = phrase("The printed board is not to be seen: {subject} ({detail}).")
    safe = phrase("The calibration of the camera stays as it is.")
    do = phrase("Print it with carpus calibrate-camera --board, and hold all of it in the picture, in good light.")


class BoardViewsAlike(CarpusFault):
    happened = phrase("The pictures of the board are too few or too alike: {subject} ({detail}).")
    safe = phrase("The calibration of the camera stays as it is.")
    do = phrase(
        "Show the board in every part of the picture, tilted to all four sides, near and far, and hold it still."
    )


class BoardUnfit(CarpusFault):
    happened = phrase("The corners do not fit a flat board: {subject} ({detail}).")
    safe = phrase("The calibration of the camera stays as it is.")
    do = phrase("Glue the board onto something stiff and flat, give it light, and hold it still.")


class CardMissing(CarpusFault):
    happened = phrase("The check card is not to be seen well enough: {subject} ({detail}).")
    safe = _UNCHANGED
    do = phrase("Lay it flat under the camera, all of it in the picture, about 60 cm away, in good light.")


class PinUncheckable(CarpusFault):
    happened = phrase("The PIN cannot be checked: {subject} is missing on this computer ({detail}).")
    safe = phrase("Nothing is lost; everything stays hidden.")
    do = phrase("Whoever looks after this computer installs Carpus again, with all its parts.")
