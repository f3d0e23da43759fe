"""What can go wrong: each kind of fault with its words; :mod:`core.model.fault_text` puts the facts in.

What ``summary`` is the class's own description; a docstring adds only what it does not say. The sentences are for a
clinician: no command, option or file format, which belong into ``support``.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from carpus.core.model.phrase import Phrase, phrase

UNEXPECTED_CODE = "C-000"
"""Code of what no class foresees: a mistake of the program."""

_UNCHANGED = phrase("Nothing was changed.")
_FILE_UNCHANGED = phrase("The file was not changed.")
_RECORDING_UNCHANGED = phrase("The recording was not changed.")
_GOES_ON = phrase("The measurement continues.")
_NOTHING_YET = phrase("Nothing has been recorded yet.")
_STORED = phrase("Everything recorded so far is saved on this computer.")
_SESSION_REFERENCE = phrase("Session and reference were not changed.")
_CALIBRATION = phrase("The camera’s calibration was not changed.")
_ASK_INSTALL = phrase("Ask your IT support to install it.")
_COPY_AGAIN = phrase("Copy the recording again from its source.")
_GAPS = phrase("All other frames are used. The gaps are marked.")


class CarpusFault(Exception):
    """Something the person at the desk must be told; an instance carries facts, its class the sentences.

    ``subject`` is the file, folder, device or marker concerned; ``detail`` the measured fact
    (a number, a name, a line), a :class:`Phrase` where it says more. Neither ever holds a patient's name.
    ``summary``, whether the data are ``data_safety`` and what to ``remedy`` have places for ``{subject}`` and
    ``{detail}``;
    ``data_safety`` says only what is known wherever the fault is raised. ``code`` identifies the class for IT
    support, in the
    window, in the log and in the documents, and never changes; ``title`` is its subject area; ``support`` is for who
    installs and repairs: commands and file names, behind “Details” in the window.
    """

    code: ClassVar[str] = UNEXPECTED_CODE
    title: ClassVar[Phrase]
    summary: ClassVar[Phrase]
    data_safety: ClassVar[Phrase]
    remedy: ClassVar[Phrase]
    support: ClassVar[str] = ""

    def __init__(self, subject: str | Path = "", detail: str = "") -> None:
        self.subject = str(subject)
        # A damaged file's own words may be no text; what is told must be storable and printable everywhere.
        storable = str(detail).encode("utf-8", "backslashreplace").decode("utf-8")
        self.detail = detail if isinstance(detail, Phrase) and detail == storable else storable
        super().__init__(f"{self.code} {type(self).__name__}: {self.subject} {self.detail}".strip())


class RecordingMissing(CarpusFault):
    code = "C-101"
    title = phrase("Recording")
    summary = phrase("Recording not found: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Check the name and the folder.")


class RecordingUnreadable(CarpusFault):
    code = "C-102"
    title = phrase("Recording")
    summary = phrase("The recording cannot be read: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Copy the recording again, or correct its list of frames.")


class RecordingEmpty(CarpusFault):
    code = "C-103"
    title = phrase("Recording")
    summary = phrase("The recording contains no frames: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Choose another recording, or record again.")


class FrameDamaged(CarpusFault):
    code = "C-104"
    title = phrase("Recording")
    summary = phrase("A frame of the recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN
    support: ClassVar[str] = phrase("“carpus track --leave-out-damaged” continues without it.")


class InitialFrameDamaged(FrameDamaged):
    """The one on which the markers are clicked, without which nothing goes on."""

    code = "C-105"
    title = phrase("Recording")
    summary = phrase("The first frame of the recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN
    support = ""


class FrameSizeChanged(CarpusFault):
    code = "C-106"
    title = phrase("Recording")
    summary = phrase("The frames of the recording differ in size: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Use a recording whose frames all have the same size.")


class TimesUnordered(CarpusFault):
    code = "C-107"
    title = phrase("Recording")
    summary = phrase("The frame times are out of order: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Record again, or correct the list of frames.")


class DepthMissing(CarpusFault):
    code = "C-108"
    title = phrase("Recording")
    summary = phrase("The recording has no usable depth: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Use a recording with colour and depth.")


class CameraFileUnreadable(CarpusFault):
    code = "C-201"
    title = phrase("Camera")
    summary = phrase("The camera file cannot be used: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Calibrate the camera again, or correct the file.")


class ClicksUnreadable(CarpusFault):
    code = "C-301"
    title = phrase("Markers")
    summary = phrase("The clicked markers cannot be read: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Click the markers again, or correct the file.")


class ProtocolUnknown(CarpusFault):
    code = "C-302"
    title = phrase("Markers")
    summary = phrase("There is no marker set called {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Use wrist6 or hand21.")


class ClickOutsideImage(CarpusFault):
    code = "C-303"
    title = phrase("Markers")
    summary = phrase("A click lies outside the image: {subject} ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Click the marker in the first frame of this recording.")


class ClickOnNoMarker(CarpusFault):
    code = "C-304"
    title = phrase("Markers")
    summary = phrase("No separate blue marker was found at a click: {subject}.")
    data_safety = _NOTHING_YET
    remedy = phrase("Click closer to the marker, or check the light.")


class MarkerWithoutDepth(CarpusFault):
    code = "C-305"
    title = phrase("Markers")
    summary = phrase("The camera measures no depth at a marker: {subject}.")
    data_safety = _NOTHING_YET
    remedy = phrase("Move the hand a little. Keep sunlight and reflections off the markers.")


class CalibrationImpossible(CarpusFault):
    code = "C-306"
    title = phrase("Markers")
    summary = phrase("The clicked points do not form a hand ({subject}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Click every marker again, in the order shown.")


class OutputExists(CarpusFault):
    code = "C-401"
    title = phrase("Files")
    summary = phrase("A file with this name already exists: {subject}.")
    data_safety = phrase("That file was not changed.")
    remedy = phrase("Choose another name.")


class ExtraMissing(CarpusFault):
    """A Python package that is installed only when asked for is not installed; ``subject`` is its name."""

    code = "C-001"
    title = phrase("Installation")
    summary = phrase("A Python package that this needs is not installed: {subject}.")
    data_safety = _UNCHANGED
    remedy = _ASK_INSTALL


class CompiledPartMissing(CarpusFault):
    """Modules of ``core/compiled`` that are there as source alone; ``subject`` names them."""

    code = "C-002"
    title = phrase("Installation")
    summary = phrase("Carpus was not installed completely: a compiled part is missing ({subject}).")
    data_safety = _UNCHANGED
    remedy = phrase("Install Carpus again.")


class SchedulerUnreachable(CarpusFault):
    code = "C-003"
    title = phrase("Installation")
    summary = phrase("The scheduler at {subject} does not answer ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Check the address.")
    support = phrase("Without --scheduler this computer does the work.")


class OutputBusy(CarpusFault):
    code = "C-402"
    title = phrase("Files")
    summary = phrase("Another program is writing {subject}.")
    data_safety = phrase("It is left to that program.")
    remedy = phrase("Wait until it has finished, or choose another folder.")


class OutputNotWritable(CarpusFault):
    code = "C-403"
    title = phrase("Files")
    summary = phrase("Carpus cannot write to {subject} ({detail}).")
    data_safety = phrase("Everything saved before is safe.")
    remedy = phrase("Check that the folder exists and that you may write there, or choose another folder.")


class DiskFull(CarpusFault):
    """No room was left while writing; what was written is kept."""

    code = "C-404"
    title = phrase("Files")
    summary = phrase("The disk has no space left for {subject} ({detail}).")
    data_safety = phrase("Everything saved before is safe. What was being written may be missing.")
    remedy = phrase("Free some space, or choose another disk.")


class SessionUnreadable(CarpusFault):
    code = "C-501"
    title = phrase("Session")
    summary = phrase("This session cannot be opened: {subject} ({detail}).")
    data_safety = phrase("The file was not changed. All other sessions are safe.")
    remedy = phrase("If it was copied, copy it again. Otherwise restore it from a backup.")


class SessionMissing(SessionUnreadable):
    code = "C-502"
    title = phrase("Session")
    summary = phrase("File not found: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Check the path.")


class SessionChanged(CarpusFault):
    code = "C-503"
    title = phrase("Session")
    summary = phrase("This session was modified after it was completed: {subject}.")
    data_safety = phrase("It can be opened, but its values may have been altered.")
    remedy = phrase("Use the copy in a backup.")
    support = phrase("Its SHA-256 checksum does not match.")


class SessionUnfinished(SessionUnreadable):
    """A part file of Carpus 0.2.0, which only its recovery reads."""

    code = "C-504"
    title = phrase("Session")
    summary = phrase("This session is not finished: {subject}.")
    data_safety = phrase("What was recorded is safe.")
    remedy = phrase("Wait until its recording has ended, or restart Carpus: it completes the session.")
    support = phrase("“carpus recover” completes it too.")


class ReferenceUnreadable(CarpusFault):
    code = "C-601"
    title = phrase("Comparison")
    summary = phrase("The reference cannot be read: {subject} ({detail}).")
    data_safety = _SESSION_REFERENCE
    remedy = phrase("Use C3D, TRC, MOT, a CSV table with its column map, or a session.")


class ReferenceUnsuited(CarpusFault):
    code = "C-602"
    title = phrase("Comparison")
    summary = phrase("The reference has nothing to compare: {subject} ({detail}).")
    data_safety = _SESSION_REFERENCE
    remedy = phrase("Check that it is the same movement, and state which column or marker is which.")


class StudyUnsuited(CarpusFault):
    code = "C-603"
    title = phrase("Comparison")
    summary = phrase("These sessions are not a test-retest study: {subject} ({detail}).")
    data_safety = phrase("The limits of change stay as they are.")
    remedy = phrase("Measure at least 10 people twice within 14 days, with the markers placed anew each time.")


class SettingsInvalid(CarpusFault):
    code = "C-004"
    title = phrase("Settings")
    summary = phrase("A setting is invalid: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Correct the setting, or remove it to use the default.")


class ConcurrentChange(CarpusFault):
    """Somebody else changed the same thing since it was read; ``subject`` is its table."""

    code = "C-701"
    title = phrase("Patients")
    summary = phrase("Someone else changed this record, so your change was not saved.")
    data_safety = phrase("The other change is saved.")
    remedy = phrase("Open it again and enter your change once more.")


class PseudonymNumbered(CarpusFault):
    """A pseudonym was given on two computers before they had one store; the number ``detail`` was put behind the second
    one."""

    code = "C-702"
    title = phrase("Patients")
    summary = phrase("Two patients had the name {subject}: the second one now has ({detail}) after it.")
    data_safety = phrase("Their sessions are kept apart.")
    remedy = phrase("If another name is better, change it in the patient’s entry.")


class ServerUnavailable(CarpusFault):
    """The clinic's server for records does not answer; nobody waits for it."""

    code = "C-703"
    title = phrase("Patients")
    summary = phrase("The clinic’s records server does not answer: {subject} ({detail}).")
    data_safety = phrase("All sessions are safe. What was being entered may not be saved.")
    remedy = phrase("Continue measuring. If the server stays away, ask your IT support.")


class NameUnsuited(CarpusFault):
    code = "C-704"
    title = phrase("Patients")
    summary = phrase("This cannot be used as a name: {detail} ({subject}).")
    data_safety = _UNCHANGED
    remedy = phrase("Type the name instead of pasting it.")


class DriverMissing(CarpusFault):
    code = "C-202"
    title = phrase("Camera")
    summary = phrase("The camera driver is not installed or cannot be loaded ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Ask your IT support to install the driver.")
    support = phrase("“carpus doctor” says what is missing and how to install it.")


class DriverFailed(CarpusFault):
    """The library of a camera died or no longer answers; it ran in a process of its own."""

    code = "C-203"
    title = phrase("Camera")
    summary = phrase("The camera driver has stopped: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Unplug the camera, plug it in again and start once more.")


class CameraUnknown(CarpusFault):
    code = "C-204"
    title = phrase("Camera")
    summary = phrase("There is no camera type called {subject} ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Choose the camera in the settings.")
    support = phrase("On the command line, --camera names it.")


class CameraMissing(CarpusFault):
    code = "C-205"
    title = phrase("Camera")
    summary = phrase("No camera was found ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Plug the camera directly into the computer.")


class CameraBusy(CarpusFault):
    code = "C-206"
    title = phrase("Camera")
    summary = phrase("Another program is using the camera ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Close the other program, then try again.")


class CameraPermission(CarpusFault):
    code = "C-207"
    title = phrase("Camera")
    summary = phrase("You do not have permission to open the camera ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Ask your IT support for access to the camera.")
    support = phrase("“carpus doctor” says how to give it.")


class CameraUnsuited(CarpusFault):
    code = "C-208"
    title = phrase("Camera")
    summary = phrase("This camera does not deliver the images that Carpus needs: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Use a camera with colour and depth, such as the Xtion.")


class CameraLost(CarpusFault):
    """The camera was unplugged or sends no more pictures. Told when it happens, raised when it does not come back."""

    code = "C-209"
    title = phrase("Camera")
    summary = phrase("The camera has stopped sending images: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Plug the camera in again. Tracking and recording then continue automatically.")


class CameraMismatch(CameraLost):
    """Another camera is plugged in than the one that is wanted. Told while that one is away; raised at the opening."""

    code = "C-210"
    title = phrase("Camera")
    summary = phrase("A different camera is connected ({detail}). Carpus expects {subject}.")
    data_safety = _STORED
    remedy = phrase("Connect the expected camera. What was begun then continues automatically.")


class CameraReturned(CarpusFault):
    """Told, never raised: the lost camera delivers again; ``detail`` is how long it was away."""

    code = "C-211"
    title = phrase("Camera")
    summary = phrase("The camera is back: {subject} (away for {detail}).")
    data_safety = _STORED
    remedy = phrase("Continue. The gap is marked in the session.")


class ExposureUnstable(CarpusFault):
    """Told, never raised."""

    code = "C-212"
    title = phrase("Camera")
    summary = phrase("The camera cannot keep its exposure constant: {subject}.")
    data_safety = _GOES_ON
    remedy = phrase("Keep the light constant while you measure.")


class RecordingDamaged(CarpusFault):
    code = "C-109"
    title = phrase("Recording")
    summary = phrase("The recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN


class RecordingUnsupported(CarpusFault):
    code = "C-110"
    title = phrase("Recording")
    summary = phrase("The image format of this recording is not supported: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Record again with colour and depth of the same size.")


class DamagedFramesExcluded(CarpusFault):
    """Told, never raised: damaged pictures of a recording were left out; ``detail`` counts them."""

    code = "C-111"
    title = phrase("Recording")
    summary = phrase("Damaged frames were excluded: {subject} ({detail}).")
    data_safety = _GAPS
    remedy = phrase("If there are many, copy the recording again.")


class FramesEnlarged(CarpusFault):
    """Told, never raised: pictures of one kind were smaller and have been enlarged."""

    code = "C-112"
    title = phrase("Recording")
    summary = phrase("Some frames are smaller and were enlarged: {subject} ({detail}).")
    data_safety = _GOES_ON
    remedy = phrase("Use the same size for colour and depth next time.")


class IntrinsicsAssumed(CarpusFault):
    """Told, never raised: no camera file says how this camera sees, so ``detail`` is used in its place."""

    code = "C-213"
    title = phrase("Camera")
    summary = phrase("No camera calibration was found with {subject}: lengths may be several per cent off ({detail}).")
    data_safety = _GOES_ON
    remedy = phrase("Calibrate the camera in the settings.")
    support = phrase("Or put the camera’s camera_info.yaml beside the recording.")


class UnitAssumed(CarpusFault):
    """Told, never raised: the numbers of a recording make sense in another unit than its form has."""

    code = "C-113"
    title = phrase("Recording")
    summary = phrase("By its numbers the recording has {detail}, and Carpus reads it that way: {subject}.")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("If this is wrong, correct the list of frames or state the unit of depth.")
    support = phrase("camera_info.yaml states it as depth_unit_m.")


class RepeatedTimesExcluded(CarpusFault):
    """Told, never raised: lines of a list with the time of the one before are left out; ``detail`` counts them."""

    code = "C-114"
    title = phrase("Recording")
    summary = phrase("Frames with a repeated time were excluded: {subject} ({detail}).")
    data_safety = _GAPS
    remedy = phrase("If there are many, record again.")


class RegistrationAssumed(CarpusFault):
    """Told, never raised: nothing says whether depth lies on colour; it is taken as so."""

    code = "C-115"
    title = phrase("Recording")
    summary = phrase(
        "It is not stated whether depth and colour are aligned in {subject}; Carpus assumes that they are."
    )
    data_safety = _GOES_ON
    remedy = phrase("State it in the camera file.")
    support = phrase("Write “registered: true” or “registered: false” into camera_info.yaml.")


class DepthNotRegistered(CarpusFault):
    """Told, never raised: depth is known not to lie on colour, so depths are read beside the markers."""

    code = "C-116"
    title = phrase("Recording")
    summary = phrase("Depth and colour are not aligned in {subject}, so depths are less accurate.")
    data_safety = _GOES_ON
    remedy = phrase("Turn on depth registration in the camera settings next time.")


class DiskTooSlow(CarpusFault):
    """Pictures came faster than they could be stored; what was stored is kept."""

    code = "C-405"
    title = phrase("Files")
    summary = phrase("The disk is too slow, so the recording has ended: {subject} ({detail}).")
    data_safety = phrase("Everything saved until then is safe.")
    remedy = phrase("Record to a disk in this computer, and close other programs.")


class SmoothingFailed(CarpusFault):
    """Told, never raised to a person: looking back at a live session failed or took too long; it is as tracked."""

    code = "C-505"
    title = phrase("Session")
    summary = phrase("Smoothing of this session failed: {subject} ({detail}).")
    data_safety = phrase("The live measurement is saved.")
    remedy = phrase("You can use the session as it is.")
    support = phrase("“carpus track SESSION.h5 --output NEW.h5” repeats the smoothing.")


class MarkersNotCorrectable(CarpusFault):
    code = "C-506"
    title = phrase("Session")
    summary = phrase("The markers of this session cannot be corrected: {subject} ({detail}).")
    data_safety = phrase("The session was not changed.")
    remedy = phrase("Exclude the repetitions that are wrong, or record again.")
    support = phrase("Or track the recording again with “carpus track”.")


class ReanalysisFailed(CarpusFault):
    """Tracking a session again with corrected markers did not come to its end; the old result is unchanged."""

    code = "C-507"
    title = phrase("Session")
    summary = phrase("The re-analysis failed: {subject} ({detail}).")
    data_safety = phrase("The previous result was not changed.")
    remedy = phrase("Try again, or correct another frame first.")


class PatientListUnreadable(CarpusFault):
    code = "C-705"
    title = phrase("Patients")
    summary = phrase("The patient list cannot be opened: {subject} ({detail}).")
    data_safety = phrase("Session files are safe. Keep this file: names and notes are stored in it alone.")
    remedy = phrase("Restart Carpus. If that does not help, ask your IT support.")


class PatientListVersionUnknown(PatientListUnreadable):
    """A register of a newer Carpus, or one that says no version that there is."""

    code = "C-706"
    title = phrase("Patients")
    summary = phrase("The patient list was made by another version of Carpus: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Update Carpus on this computer.")


class PatientListBusy(PatientListUnreadable):
    code = "C-707"
    title = phrase("Patients")
    summary = phrase("The patient list is open in another window of Carpus or another program: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Close it there, then try again.")


class PatientListReadOnly(PatientListUnreadable):
    """Of a window that is open on another computer, or of one that ended without warning."""

    code = "C-708"
    title = phrase("Patients")
    summary = phrase("Recent changes to the patient list cannot be read, because the folder is read-only: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Close Carpus on other computers. If that does not help, ask your IT support for write access.")


class PatientListDamaged(PatientListUnreadable):
    """The register's file is broken or not a register; reading it again does not help."""

    code = "C-709"
    title = phrase("Patients")
    summary = phrase("The patient list is damaged: {subject} ({detail}).")
    data_safety = PatientListUnreadable.data_safety
    remedy = phrase("Restart Carpus: it keeps what can still be read. If names are missing, restore a backup.")


class PatientListRebuilt(CarpusFault):
    """Told, never raised: a damaged register was given another name, and the list made again from the sessions."""

    code = "C-710"
    title = phrase("Patients")
    summary = phrase(
        "The patient list was damaged. It was rebuilt from the sessions and what could be read ({detail})."
    )
    data_safety = phrase(
        "All sessions are safe. Names, notes and comments may be missing. The damaged list is kept as {subject}."
    )
    remedy = phrase("Check the list, or restore a backup.")


class PatientListMissing(CarpusFault):
    """Told, never raised: there are sessions and no list of patients, so that one was made from them."""

    code = "C-711"
    title = phrase("Patients")
    summary = phrase("The patient list was missing and was rebuilt from the sessions: {subject}.")
    data_safety = phrase(
        "All sessions are safe. If there was a list before, its names, notes and comments are missing."
    )
    remedy = phrase("Restore a backup, or enter the names again.")


class LogProtectionRestored(CarpusFault):
    """Told, never raised: what keeps the log from being changed had been taken out of the store."""

    code = "C-712"
    title = phrase("Patients")
    summary = phrase("The write protection of the audit log in {subject} had been removed. Carpus has restored it.")
    data_safety = phrase("Patients and sessions are safe. Entries of the log may have been altered.")
    remedy = phrase("Compare the log with a backup, and tell your data-protection officer.")


class SessionFilesIgnored(CarpusFault):
    """Told, never raised: files among the sessions that are none; ``subject`` names some, ``detail`` counts them."""

    code = "C-508"
    title = phrase("Session")
    summary = phrase("{detail} among the sessions cannot be read and were ignored: {subject}.")
    data_safety = phrase("They were not changed. All other sessions are safe.")
    remedy = phrase("Restore them from a backup.")


class SessionSpooled(CarpusFault):
    """Told, never raised: a finished session waits at ``subject`` until the folder of the sessions can be reached."""

    code = "C-406"
    title = phrase("Files")
    summary = phrase("The session folder is not available ({detail}). The session is saved in {subject}.")
    data_safety = phrase("It is safe on this computer.")
    remedy = phrase("Continue. When the disk or network is back, Carpus moves the session automatically.")


class RecordingTooShort(CarpusFault):
    """Told, never raised: a recording had ended before its first frame was stored."""

    code = "C-117"
    title = phrase("Recording")
    summary = phrase("A recording ended before its first second was saved: {subject}. There is nothing to recover.")
    data_safety = phrase("Everything recorded before is safe.")
    remedy = phrase("Record this exercise again.")


class SpooledSessionErased(CarpusFault):
    """Told, never raised: a recording that waited on this computer was of a patient who has been erased meanwhile."""

    code = "C-713"
    title = phrase("Patients")
    summary = phrase("A recording that waited on this computer belonged to a deleted patient and was deleted as well.")
    data_safety = phrase("Nothing else was changed.")
    remedy = phrase("No action is needed.")


class SpooledSessionMoved(CarpusFault):
    """Told, never raised: a session that waited on this computer is among the others now."""

    code = "C-407"
    title = phrase("Files")
    summary = phrase("A session that was kept on this computer is now in the session folder: {subject}.")
    data_safety = phrase("It is complete.")
    remedy = phrase("Review it like any other session.")


class FolderMissing(CarpusFault):
    code = "C-408"
    title = phrase("Files")
    summary = phrase("There is no folder {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the sessions.")


class SessionShareEmpty(FolderMissing):
    code = "C-409"
    title = phrase("Files")
    summary = phrase("The session folder contains nothing from Carpus: {subject}.")
    data_safety = phrase("Nothing was changed. New recordings are kept on this computer.")
    remedy = phrase("Check that the network share is connected.")


class DataFolderMissing(CarpusFault):
    code = "C-410"
    title = phrase("Files")
    summary = phrase("The folder contains no Carpus data: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the patients.")
    support = phrase("“carpus doctor” says which one it is.")


class DataFolderChanged(CarpusFault):
    """Told at a start: ``subject`` is opened, ``detail`` is the folder of the start before, or of the settings."""

    code = "C-411"
    title = phrase("Files")
    summary = phrase("Carpus now uses another data folder: {subject}.")
    data_safety = phrase("Before it was {detail}. Nothing was moved.")
    remedy = phrase("If patients are missing here, choose the data folder in the settings.")


class FolderInUse(CarpusFault):
    code = "C-412"
    title = phrase("Files")
    summary = phrase("Another Carpus is using this data folder: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Use the window that is already open, or choose another folder.")


class SessionsMissing(CarpusFault):
    code = "C-509"
    title = phrase("Session")
    summary = phrase("There is no session in {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Measure one, or choose the folder that contains the sessions.")


class PatientUnknown(CarpusFault):
    code = "C-714"
    title = phrase("Patients")
    summary = phrase("There is no patient called {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Choose an existing patient.")


class PseudonymTaken(CarpusFault):
    code = "C-715"
    title = phrase("Patients")
    summary = phrase("The name {subject} belongs to another patient.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose another name.")


class ErasureUnfinished(CarpusFault):
    """Files of what was erased could not be deleted yet; ``subject`` names one, ``detail`` counts them."""

    code = "C-716"
    title = phrase("Patients")
    summary = phrase("Not all files could be deleted yet ({detail} left, such as {subject}).")
    data_safety = phrase("They are no longer listed. Carpus tries again at each start.")
    remedy = phrase("Close other programs that use them, then restart Carpus.")


class ErasureBlockedByLink(CarpusFault):
    """Nothing was erased: ``subject`` is a link on the way to what should go."""

    code = "C-717"
    title = phrase("Patients")
    summary = phrase("Nothing was deleted: {subject} is a link to another place.")
    data_safety = phrase("Everything is as it was.")
    remedy = phrase("Ask your IT support to replace the link by its target, then delete again.")


class BackupFolderUnsuited(CarpusFault):
    code = "C-801"
    title = phrase("Backup")
    summary = phrase("Backups cannot be stored there: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Choose a folder on another disk.")


class BackupIncomplete(CarpusFault):
    """Told after a back-up: ``subject`` is missing or cannot be read, and so are ``detail`` files in all."""

    code = "C-802"
    title = phrase("Backup")
    summary = phrase("The backup is incomplete: {subject} is missing or cannot be read; {detail} in all.")
    data_safety = phrase("All other files are in the backup.")
    remedy = phrase("Reconnect the session folder or its disk, then back up again.")


class BackupMismatch(CarpusFault):
    """What is read back of a back-up is not what was written; ``subject`` begins the name of its content."""

    code = "C-803"
    title = phrase("Backup")
    summary = phrase(
        "The backup’s verification failed: a file read back differs from the original ({subject}, {detail})."
    )
    data_safety = phrase("The data on this computer are intact.")
    remedy = phrase("Back up to another disk now, and replace this one.")


class BackupUnreadable(CarpusFault):
    code = "C-804"
    title = phrase("Backup")
    summary = phrase("The backup cannot be read: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Choose another backup, or update Carpus.")


class BackupMissing(CarpusFault):
    code = "C-805"
    title = phrase("Backup")
    summary = phrase("There is no backup in {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the backups.")


class BoardNotVisible(CarpusFault):
    code = "C-214"
    title = phrase("Camera")
    summary = phrase("The calibration board is not visible: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Hold the whole printed board in the camera image, in good light.")
    support = phrase("“carpus calibrate-camera --board” prints it.")


class BoardViewsTooSimilar(CarpusFault):
    code = "C-215"
    title = phrase("Camera")
    summary = phrase("The images of the board are too few or too similar: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Show the board everywhere in the image, tilted to all four sides, near and far. Hold it still.")


class BoardUnfit(CarpusFault):
    code = "C-216"
    title = phrase("Camera")
    summary = phrase("The corners do not fit a flat board: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Glue the board to something stiff and flat, light it well, and hold it still.")


class CardNotVisible(CarpusFault):
    code = "C-217"
    title = phrase("Camera")
    summary = phrase("The check card is not visible: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Lay it flat under the camera, all of it in the image, about 60 cm away, in good light.")


class PinUncheckable(CarpusFault):
    code = "C-901"
    title = phrase("Lock")
    summary = phrase("The PIN cannot be checked: {subject} is missing on this computer ({detail}).")
    data_safety = phrase("Nothing is lost. Everything stays hidden.")
    remedy = phrase("Ask your IT support to reinstall Carpus.")
