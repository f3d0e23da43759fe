"""Faults: errors and notices with the sentences that a person reads; :mod:`core.model.fault_text` fills in the facts.

The sentences are for a clinician: commands, options and file formats belong into ``support``.
"""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

from carpus.core.model.phrase import Phrase, fill_template, phrase

UNEXPECTED_CODE = "C-000"
"""Code of an error of the program itself."""

_UNCHANGED = phrase("Nothing was changed.")
_FILE_UNCHANGED = phrase("The file was not changed.")
_RECORDING_UNCHANGED = phrase("The recording was not changed.")
_GOES_ON = phrase("The measurement continues.")
_NOTHING_YET = phrase("Nothing has been recorded yet.")
_STORED = phrase("Everything recorded so far is saved on this computer.")
_SESSION_REFERENCE = phrase("The session and the reference were not changed.")
_CALIBRATION = phrase("The camera’s calibration was not changed.")
_ASK_INSTALL = phrase("Ask your IT support to install it.")
_COPY_AGAIN = phrase("Copy the recording again from its source.")
_GAPS = phrase("All other frames are used. The gaps are marked.")


_TITLES = {
    "0": phrase("Installation"), "1": phrase("Recording"), "2": phrase("Camera"), "3": phrase("Markers"),
    "4": phrase("Files"), "5": phrase("Session"), "6": phrase("Comparison"), "7": phrase("Patients"),
    "8": phrase("Backup"), "9": phrase("Lock"),
}  # fmt: skip
"""Subject areas by the first digit of the code."""


class CarpusFault(Exception):
    """Error that a person must be told about; an instance carries facts, its class the sentences.

    ``subject`` is the file, folder, device or marker concerned; ``detail`` the measured fact, a :class:`Phrase` where
    it says more. Neither ever holds a patient's name. ``summary`` (what happened), ``data_safety`` and ``remedy`` (what
    to do) have places for ``{subject}`` and ``{detail}``. ``data_safety`` says only what is known wherever the fault is
    raised. ``code`` identifies the class for IT support and never changes; ``title`` is its subject area; ``support``
    names commands and files for whoever installs and repairs, shown behind “Details” in the window.
    """

    code: ClassVar[str] = UNEXPECTED_CODE
    title: ClassVar[Phrase]
    summary: ClassVar[Phrase]
    data_safety: ClassVar[Phrase]
    remedy: ClassVar[Phrase]
    support: ClassVar[str] = ""

    def __init_subclass__(cls, code: str = "") -> None:
        if code:
            cls.code = code
            cls.title = vars(cls).get("title", _TITLES[code[2]])

    def __init__(self, subject: str | Path = "", detail: str = "") -> None:
        self.subject = str(subject)
        # A damaged file's own words may be no text, and the detail must be storable and printable everywhere.
        storable = str(detail).encode("utf-8", "backslashreplace").decode("utf-8")
        self.detail = detail if isinstance(detail, Phrase) and detail == storable else storable
        super().__init__(f"{self.code} {type(self).__name__}: {self.subject} {self.detail}".strip())
        if hasattr(self, "summary"):  # the sentences, for a traceback in a notebook
            self.add_note(fill_template(f"{self.summary} {self.remedy}", self.subject, self.detail))


class Notice(CarpusFault):
    """Fault that is shown, never raised."""


class RecordingMissing(CarpusFault, code="C-101"):
    summary = phrase("Recording not found: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Check the name and the folder.")


class RecordingUnreadable(CarpusFault, code="C-102"):
    summary = phrase("The recording cannot be read: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Copy the recording again from its source, or correct its list of frames.")


class RecordingEmpty(CarpusFault, code="C-103"):
    summary = phrase("The recording contains no frames: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Choose another recording, or record again.")


class FrameDamaged(CarpusFault, code="C-104"):
    summary = phrase("A frame of the recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN
    support: ClassVar[str] = phrase("“carpus track --leave-out-damaged” continues without the damaged frames.")


class InitialFrameDamaged(FrameDamaged, code="C-105"):
    summary = phrase("The first frame of the recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN
    support = ""


class FrameSizeChanged(CarpusFault, code="C-106"):
    summary = phrase("The frames of the recording differ in size: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Use a recording whose frames all have the same size.")


class TimesUnordered(CarpusFault, code="C-107"):
    summary = phrase("The frame times are out of order: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Record again, or correct the list of frames.")


class DepthMissing(CarpusFault, code="C-108"):
    summary = phrase("The recording has no usable depth: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Use a recording with colour and depth.")


class CameraFileUnreadable(CarpusFault, code="C-201"):
    summary = phrase("The camera file cannot be used: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Calibrate the camera again, or correct the file.")


class ClicksUnreadable(CarpusFault, code="C-301"):
    summary = phrase("The clicked markers cannot be read: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Click the markers again, or correct the file.")


class ProtocolUnknown(CarpusFault, code="C-302"):
    summary = phrase("There is no marker set with the name {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Use the marker set wrist6 or hand21.")


class ClickOutsideImage(CarpusFault, code="C-303"):
    summary = phrase("A click lies outside the image: {subject} ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Click the marker in the first frame of this recording.")


class ClickOnNoMarker(CarpusFault, code="C-304"):
    summary = phrase("No separate blue marker was found at a click: {subject}.")
    data_safety = _NOTHING_YET
    remedy = phrase("Click nearer to the marker, or check the light.")


class MarkerWithoutDepth(CarpusFault, code="C-305"):
    summary = phrase("The camera cannot measure the depth at a marker: {subject}.")
    data_safety = _NOTHING_YET
    remedy = phrase("Move the hand a little. Keep sunlight and reflections off the markers.")


class CalibrationImpossible(CarpusFault, code="C-306"):
    summary = phrase("The clicked points do not form a hand ({subject}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Click every marker again, in the order shown.")


class OutputExists(CarpusFault, code="C-401"):
    summary = phrase("A file with this name already exists: {subject}.")
    data_safety = phrase("The file was not changed.")
    remedy = phrase("Choose another name.")


class GdtUnreadable(CarpusFault, code="C-413"):
    summary = phrase("The file from the clinic software cannot be read: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Send the patient again from the clinic software, or choose the patient in Carpus.")


class ExtraMissing(CarpusFault, code="C-001"):
    """``subject`` is the name of an optional Python package."""

    summary = phrase("A required Python package is not installed: {subject}.")
    data_safety = _UNCHANGED
    remedy = _ASK_INSTALL


class CompiledPartMissing(CarpusFault, code="C-002"):
    """``subject`` names modules of ``core/compiled`` that exist as source only."""

    summary = phrase("Carpus was not installed completely: a compiled part is missing ({subject}).")
    data_safety = _UNCHANGED
    remedy = phrase("Install Carpus again.")


class SchedulerUnreachable(CarpusFault, code="C-003"):
    summary = phrase("The Dask scheduler at {subject} does not respond ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Check the address of the scheduler.")
    support = phrase("Without the option --scheduler, this computer tracks the recordings.")


class OutputBusy(CarpusFault, code="C-402"):
    summary = phrase("Another program is writing {subject}.")
    data_safety = phrase("Carpus changed nothing there.")
    remedy = phrase("Wait until the other program has finished, or choose another folder.")


class OutputNotWritable(CarpusFault, code="C-403"):
    summary = phrase("Carpus cannot write to {subject} ({detail}).")
    data_safety = phrase("Everything saved before is safe.")
    remedy = phrase("Check that the folder exists and that you are allowed to write to it, or choose another folder.")


class DiskFull(CarpusFault, code="C-404"):
    """What was written before is kept."""

    summary = phrase("The disk has no space left for {subject} ({detail}).")
    data_safety = phrase("Everything saved before is safe. The data that Carpus was writing may be missing.")
    remedy = phrase("Remove files that do not belong to Carpus, or choose another disk.")


class SessionUnreadable(CarpusFault, code="C-501"):
    summary = phrase("This session cannot be opened: {subject} ({detail}).")
    data_safety = phrase("The file was not changed. All other sessions are safe.")
    remedy = phrase("If you copied the file, copy it again. Otherwise restore it from a backup.")


class SessionMissing(SessionUnreadable, code="C-502"):
    summary = phrase("File not found: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Check the name and the folder.")


class SessionChanged(CarpusFault, code="C-503"):
    summary = phrase("This session was modified after it was completed: {subject}.")
    data_safety = phrase("The session can be opened, but its values may have been altered.")
    remedy = phrase("Restore the session from a backup.")
    support = phrase("The SHA-256 checksum of the file does not match.")


class SessionUnfinished(SessionUnreadable, code="C-504"):
    """Part file of Carpus 0.2.0, which only its recovery reads."""

    summary = phrase("This session is not finished: {subject}.")
    data_safety = phrase("Everything recorded is safe.")
    remedy = phrase("Wait until the recording has ended, or restart Carpus to complete the session.")
    support = phrase("“carpus recover” also completes the session.")


class ReferenceUnreadable(CarpusFault, code="C-601"):
    summary = phrase("The reference cannot be read: {subject} ({detail}).")
    data_safety = _SESSION_REFERENCE
    remedy = phrase("Use a C3D, TRC or MOT file, a CSV table with its column map, or a session.")


class ReferenceUnsuited(CarpusFault, code="C-602"):
    summary = phrase("The reference contains nothing that can be compared: {subject} ({detail}).")
    data_safety = _SESSION_REFERENCE
    remedy = phrase("Check that the reference shows the same movement, and state which column or marker is which.")


class StudyUnsuited(CarpusFault, code="C-603"):
    summary = phrase("These sessions cannot be used as a test–retest study: {subject} ({detail}).")
    data_safety = phrase("The MDC values were not changed.")
    remedy = phrase("Measure at least 10 people twice within 14 days, and replace the markers each time.")


class SettingsInvalid(CarpusFault, code="C-004"):
    title = phrase("Settings")
    summary = phrase("A setting is invalid: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Correct the setting, or remove it to use the default.")


class ConcurrentChange(CarpusFault, code="C-701"):
    """``subject`` is the table."""

    summary = phrase("Someone else changed this record, so your change was not saved.")
    data_safety = phrase("The other change is saved.")
    remedy = phrase("Open the record again and enter your change once more.")


class PseudonymNumbered(CarpusFault, code="C-702"):
    """A pseudonym was given on two computers before they shared a store; ``detail`` was added to the second."""

    summary = phrase("Two patients had the pseudonym {subject}. The second one now has ({detail}) after it.")
    data_safety = phrase("Their sessions stay separate.")
    remedy = phrase("To use another pseudonym, edit the patient.")


class ServerUnavailable(CarpusFault, code="C-703"):
    summary = phrase("The clinic’s server does not respond: {subject} ({detail}).")
    data_safety = phrase("All sessions are safe. Your last entries may not be saved.")
    remedy = phrase("Continue measuring. If the server still does not respond, ask your IT support.")


class NameUnsuited(CarpusFault, code="C-704"):
    summary = phrase("This text cannot be used as a name: {detail} ({subject}).")
    data_safety = _UNCHANGED
    remedy = phrase("Type the name instead of pasting it.")


class DriverMissing(CarpusFault, code="C-202"):
    summary = phrase("The camera driver is not installed or cannot be loaded ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Ask your IT support to install the driver.")
    support = phrase("“carpus doctor” shows what is missing and how to install it.")


class DriverFailed(CarpusFault, code="C-203"):
    """A camera library, which runs in its own process, died or does not answer."""

    summary = phrase("The camera driver has stopped: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Unplug the camera, plug it in again, then restart the measurement.")


class CameraUnknown(CarpusFault, code="C-204"):
    summary = phrase("There is no camera type with the name {subject} ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Choose the camera in the settings.")
    support = phrase("On the command line, set it with --camera.")


class CameraMissing(CarpusFault, code="C-205"):
    summary = phrase("No camera was found ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Plug the camera directly into the computer.")


class CameraBusy(CarpusFault, code="C-206"):
    summary = phrase("Another program is using the camera ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Close the other program, then try again.")


class CameraPermission(CarpusFault, code="C-207"):
    summary = phrase("You do not have permission to open the camera ({detail}).")
    data_safety = _NOTHING_YET
    remedy = phrase("Ask your IT support for access to the camera.")
    support = phrase("“carpus doctor” shows how to grant it.")


class CameraUnsuited(CarpusFault, code="C-208"):
    summary = phrase("This camera does not deliver the images that Carpus needs: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Use a camera with colour and depth, such as the Asus Xtion.")


class CameraLost(CarpusFault, code="C-209"):
    """Reported when it happens, raised if the camera does not come back."""

    summary = phrase("The camera has stopped sending images: {subject} ({detail}).")
    data_safety = _STORED
    remedy = phrase("Plug the camera in again. Measurement and recording then continue automatically.")


class CameraMismatch(CameraLost, code="C-210"):
    """Reported while the expected camera is away; raised when a camera is opened."""

    summary = phrase("A different camera is connected ({detail}). Carpus expects {subject}.")
    data_safety = _STORED
    remedy = phrase("Connect the expected camera. Measurement and recording then continue automatically.")


class CameraReturned(Notice, code="C-211"):
    """``detail`` is how long the camera was away."""

    summary = phrase("The camera is connected again: {subject} (disconnected for {detail}).")
    data_safety = _STORED
    remedy = phrase("Continue measuring. The gap is marked in the session.")


class ExposureUnstable(Notice, code="C-212"):
    summary = phrase("The camera cannot keep its exposure constant: {subject}.")
    data_safety = _GOES_ON
    remedy = phrase("Keep the light constant while you measure.")


class RecordingDamaged(CarpusFault, code="C-109"):
    summary = phrase("The recording is damaged: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = _COPY_AGAIN


class RecordingUnsupported(CarpusFault, code="C-110"):
    summary = phrase("The image format of this recording is not supported: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("Record again with colour and depth of the same size.")


class DamagedFramesExcluded(Notice, code="C-111"):
    """``detail`` counts the frames."""

    summary = phrase("Damaged frames were excluded: {subject} ({detail}).")
    data_safety = _GAPS
    remedy = phrase("If there are many, copy the recording again.")


class FramesEnlarged(Notice, code="C-112"):
    summary = phrase("Some images are smaller than the others and were enlarged: {subject} ({detail}).")
    data_safety = _GOES_ON
    remedy = phrase("Use the same size for colour and depth next time.")


class IntrinsicsAssumed(Notice, code="C-213"):
    """``detail`` is used in place of a calibration."""

    summary = phrase(
        "There is no camera calibration for {subject}, so lengths may be wrong by several per cent ({detail})."
    )
    data_safety = _GOES_ON
    remedy = phrase("Calibrate the camera in the settings.")
    support = phrase("You can also put the file camera_info.yaml of the camera next to the recording.")


class UnitAssumed(Notice, code="C-113"):
    """The values make sense in another unit than that of the format."""

    summary = phrase("The recording has unusual units, and Carpus converts them: {subject} ({detail}).")
    data_safety = _RECORDING_UNCHANGED
    remedy = phrase("If the units are wrong, correct the list of frames or state the unit of depth.")
    support = phrase("The unit of depth is depth_unit_m in camera_info.yaml.")


class RepeatedTimesExcluded(Notice, code="C-114"):
    """``detail`` counts the lines of the list."""

    summary = phrase("Frames with a repeated time were excluded: {subject} ({detail}).")
    data_safety = _GAPS
    remedy = phrase("If there are many, record again.")


class RegistrationAssumed(Notice, code="C-115"):
    summary = phrase("{subject} does not state whether depth and colour are aligned. Carpus assumes that they are.")
    data_safety = _GOES_ON
    remedy = phrase("State in the camera file whether depth and colour are aligned.")
    support = phrase("Write “registered: true” or “registered: false” into camera_info.yaml.")


class DepthNotRegistered(Notice, code="C-116"):
    """Depths are read beside the markers."""

    summary = phrase("Depth and colour are not aligned in {subject}, so depths are less accurate.")
    data_safety = _GOES_ON
    remedy = phrase("Turn on depth registration in the camera settings next time.")


class DiskTooSlow(CarpusFault, code="C-405"):
    """Frames came faster than they could be written."""

    summary = phrase("The disk is too slow, so the recording has ended: {subject} ({detail}).")
    data_safety = phrase("Everything saved until then is safe.")
    remedy = phrase("Record to a disk in this computer, and close other programs.")


class SmoothingFailed(CarpusFault, code="C-505"):
    """The smoother failed or took too long; the session is as tracked."""

    summary = phrase("Smoothing of this session failed: {subject} ({detail}).")
    data_safety = phrase("The live measurement is saved.")
    remedy = phrase("You can use the live values of this session.")
    support = phrase("“carpus track SESSION.h5 --output NEW.h5” repeats the smoothing.")


class MarkersNotCorrectable(CarpusFault, code="C-506"):
    summary = phrase("The markers of this session cannot be corrected: {subject} ({detail}).")
    data_safety = phrase("The session was not changed.")
    remedy = phrase("Exclude the repetitions that are wrong, or record again.")
    support = phrase("You can also track the recording again with “carpus track”.")


class ReanalysisFailed(CarpusFault, code="C-507"):
    summary = phrase("The re-analysis failed: {subject} ({detail}).")
    data_safety = phrase("The previous result was not changed.")
    remedy = phrase("Try again, or correct another frame first.")


class PatientListUnreadable(CarpusFault, code="C-705"):
    summary = phrase("The patient list cannot be opened: {subject} ({detail}).")
    data_safety = phrase(
        "Session files are safe. Do not delete the patient list: no other file has the names and notes."
    )
    remedy = phrase("Restart Carpus. If that does not help, ask your IT support.")


class PatientListVersionUnknown(PatientListUnreadable, code="C-706"):
    summary = phrase("The patient list was created by another version of Carpus: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Update Carpus on this computer.")


class PatientListBusy(PatientListUnreadable, code="C-707"):
    summary = phrase("The patient list is open in another window of Carpus or another program: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Close the other window or program, then try again.")


class PatientListReadOnly(PatientListUnreadable, code="C-708"):
    """A journal was left by a window on another computer, or by one that was killed."""

    summary = phrase("Recent changes to the patient list cannot be read, because the folder is read-only: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Close Carpus on other computers. If that does not help, ask your IT support for write access.")


class PatientListDamaged(PatientListUnreadable, code="C-709"):
    """Reading it again does not help."""

    summary = phrase("The patient list is damaged: {subject} ({detail}).")
    data_safety = PatientListUnreadable.data_safety
    remedy = phrase("Restart Carpus to recover what can still be read. If names are missing, restore a backup.")


class PatientListRebuilt(Notice, code="C-710"):
    summary = phrase(
        "The patient list was damaged. It was rebuilt from the sessions and what could be read ({detail})."
    )
    data_safety = phrase(
        "All sessions are safe. Names, notes and comments may be missing. The damaged list is kept as {subject}."
    )
    remedy = phrase("Check the list, or restore a backup.")


class PatientListMissing(Notice, code="C-711"):
    summary = phrase("The patient list was missing and was rebuilt from the sessions: {subject}.")
    data_safety = phrase(
        "All sessions are safe. If there was a list before, its names, notes and comments are missing."
    )
    remedy = phrase("Restore a backup, or enter the names again.")


class SessionFilesIgnored(Notice, code="C-508"):
    """``subject`` names some of the files, ``detail`` counts them."""

    summary = phrase("{detail} in the session folder cannot be read and were ignored: {subject}.")
    data_safety = phrase("These files were not changed. All other sessions are safe.")
    remedy = phrase("Restore these files from a backup.")


class SessionSpooled(Notice, code="C-406"):
    """``subject`` is where the session waits."""

    summary = phrase("The session folder is not available ({detail}). The session is saved in {subject}.")
    data_safety = phrase("The session is safe on this computer.")
    remedy = phrase(
        "Continue measuring. When the disk or network is available again, Carpus moves the session automatically."
    )


class RecordingTooShort(Notice, code="C-117"):
    summary = phrase("A recording ended before its first second was saved, so it cannot be recovered: {subject}.")
    data_safety = phrase("Everything recorded before is safe.")
    remedy = phrase("Record this exercise again.")


class SpooledSessionErased(Notice, code="C-713"):
    summary = phrase("A recording still on this computer belonged to a deleted patient and was deleted as well.")
    data_safety = phrase("Nothing else was changed.")
    remedy = phrase("You do not need to do anything.")


class SpooledSessionMoved(Notice, code="C-407"):
    summary = phrase("A session that was saved on this computer is now in the session folder: {subject}.")
    data_safety = phrase("The session is complete.")
    remedy = phrase("Review it like any other session.")


class FolderMissing(CarpusFault, code="C-408"):
    summary = phrase("There is no folder {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the sessions.")


class SessionShareEmpty(FolderMissing, code="C-409"):
    summary = phrase("The session folder contains no Carpus data: {subject}.")
    data_safety = phrase("Nothing was changed. New recordings are kept on this computer.")
    remedy = phrase("Check that the network share is connected.")


class DataFolderMissing(CarpusFault, code="C-410"):
    summary = phrase("The folder contains no Carpus data: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the patients.")
    support = phrase("“carpus doctor” shows which data folder is used.")


class FolderInUse(CarpusFault, code="C-412"):
    summary = phrase("Another Carpus program is using this data folder: {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Use the window that is already open, or choose another folder.")


class SessionsMissing(CarpusFault, code="C-509"):
    summary = phrase("There is no session in {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Measure a session, or choose the folder that contains the sessions.")


class PatientUnknown(CarpusFault, code="C-714"):
    summary = phrase("There is no patient called {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Choose an existing patient.")


class PseudonymTaken(CarpusFault, code="C-715"):
    summary = phrase("The pseudonym {subject} belongs to another patient.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose another name.")


class ErasureUnfinished(CarpusFault, code="C-716"):
    """``subject`` names one of ``detail`` files."""

    summary = phrase("Not all files could be deleted yet ({detail} left, such as {subject}).")
    data_safety = phrase("The files are no longer listed. Carpus tries to delete them again at each start.")
    remedy = phrase("Close other programs that use these files, then restart Carpus.")


class ErasureBlockedByLink(CarpusFault, code="C-717"):
    """``subject`` is the link."""

    summary = phrase("Nothing was deleted: {subject} is a link to another place.")
    data_safety = phrase("Nothing was changed.")
    remedy = phrase("Ask your IT support to replace the link with its target, then delete again.")


class BackupFolderUnsuited(CarpusFault, code="C-801"):
    summary = phrase("Backups cannot be saved there: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Choose a folder on another disk.")


class BackupIncomplete(CarpusFault, code="C-802"):
    """``subject`` is one of ``detail`` files that cannot be read."""

    summary = phrase("The backup is incomplete: {subject} is missing or cannot be read ({detail} in total).")
    data_safety = phrase("All other files are in the backup.")
    remedy = phrase("Reconnect the session folder or its disk, then back up again.")


class BackupMismatch(CarpusFault, code="C-803"):
    """``subject`` begins the name of the content."""

    summary = phrase("The backup failed verification: a file in it differs from the original ({subject}, {detail}).")
    data_safety = phrase("The data on this computer are intact.")
    remedy = phrase("Back up to another disk now, and replace the faulty disk.")


class BackupUnreadable(CarpusFault, code="C-804"):
    summary = phrase("The backup cannot be read: {subject} ({detail}).")
    data_safety = _FILE_UNCHANGED
    remedy = phrase("Choose another backup, or update Carpus.")


class BackupMissing(CarpusFault, code="C-805"):
    summary = phrase("There is no backup in {subject}.")
    data_safety = _UNCHANGED
    remedy = phrase("Choose the folder that contains the backups.")


class BoardNotVisible(CarpusFault, code="C-214"):
    summary = phrase("The calibration board is not visible: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Hold the whole printed board in the camera image, in good light.")
    support = phrase("“carpus calibrate-camera --board” writes the board as a PDF to print.")


class BoardViewsTooSimilar(CarpusFault, code="C-215"):
    summary = phrase("The images of the board are too few or too similar: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Show the board in all parts of the image, tilted to all four sides, near and far. Hold it still.")


class BoardUnfit(CarpusFault, code="C-216"):
    summary = phrase("The corners do not fit a flat board: {subject} ({detail}).")
    data_safety = _CALIBRATION
    remedy = phrase("Glue the board onto something stiff and flat, use good light, and hold the board still.")


class CardNotVisible(CarpusFault, code="C-217"):
    summary = phrase("The check card is not visible: {subject} ({detail}).")
    data_safety = _UNCHANGED
    remedy = phrase("Lay the card flat under the camera, fully in view, about 60 cm away, in good light.")


class PinUncheckable(CarpusFault, code="C-901"):
    summary = phrase("The PIN cannot be checked: {subject} is missing on this computer ({detail}).")
    data_safety = phrase("Nothing is lost. Names, images and values stay hidden.")
    remedy = phrase("Ask your IT support to reinstall Carpus.")
