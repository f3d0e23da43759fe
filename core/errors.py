"""What can go wrong, as facts. The words for each kind are in :mod:`core.words`."""

from __future__ import annotations

from pathlib import Path

from carpus.core.phrase import Phrase


class CarpusFault(Exception):
    """Something the person at the desk must be told; carries facts, no prose.

    ``subject`` is the file, folder, device or marker concerned; ``detail`` the measured fact
    (a number, a name, a line), a :class:`Phrase` where it says more. Neither ever holds a patient's name.
    """

    def __init__(self, subject: str | Path = "", detail: str = "") -> None:
        self.subject = str(subject)
        # A damaged file's own words may be no text; what is told must be storable and printable everywhere.
        storable = str(detail).encode("utf-8", "backslashreplace").decode("utf-8")
        self.detail = detail if isinstance(detail, Phrase) and detail == storable else storable
        super().__init__(f"{type(self).__name__}: {self.subject} {self.detail}".strip())


class RecordingMissing(CarpusFault):
    """There is nothing at the recording's path."""


class RecordingUnreadable(CarpusFault):
    """A recording is there but its lists or headers cannot be read."""


class RecordingEmpty(CarpusFault):
    """A recording holds no picture."""


class PictureDamaged(CarpusFault):
    """One picture of a recording is missing or cannot be decoded."""


class PictureSizeChanged(CarpusFault):
    """Pictures of one recording differ in size, or colour and depth do."""


class TimesUnordered(CarpusFault):
    """The times of a recording do not rise strictly."""


class DepthMissing(CarpusFault):
    """A recording has no depth pictures although depth was asked for."""


class CameraFileUnreadable(CarpusFault):
    """The camera's intrinsics file cannot be used."""


class ClicksUnreadable(CarpusFault):
    """The file of clicks is missing, not JSON, or not of the agreed form."""


class ProtocolUnknown(CarpusFault):
    """No marker protocol has this name."""


class ClickOutsidePicture(CarpusFault):
    """A click lies outside the first picture."""


class ClickOnNoMarker(CarpusFault):
    """There is no blob under a click."""


class MarkerWithoutDepth(CarpusFault):
    """A clicked marker has no usable depth."""


class CalibrationImpossible(CarpusFault):
    """The clicked markers do not fix a palm (too few, in one line, or not a hand)."""


class OutputExists(CarpusFault):
    """The output file is there already and is never overwritten."""


class ExtraMissing(CarpusFault):
    """A Python package that is installed only when asked for is not installed; ``subject`` is its name."""


class SchedulerUnreachable(CarpusFault):
    """The scheduler of a cluster does not answer."""


class OutputBusy(CarpusFault):
    """Another process is writing the output at this moment."""


class OutputNotWritable(CarpusFault):
    """The output's folder cannot be written to."""


class DiskFull(CarpusFault):
    """No room was left while writing; what was written is kept."""


class SessionUnreadable(CarpusFault):
    """A file is not a session that this version reads."""


class SessionChanged(CarpusFault):
    """A session can be read, but its seal does not fit: something in it was changed after it was finished."""


class SessionUnfinished(CarpusFault):
    """A session that is still being recorded or was cut short; it has no seal yet."""


class ReferenceUnreadable(CarpusFault):
    """A file of another measurement, to be compared with, cannot be read."""


class ReferenceUnsuited(CarpusFault):
    """A reference can be read, but nothing in it can be compared with the session."""


class StudyUnsuited(CarpusFault):
    """Sessions of test and retest do not make a study, or one that may be put into force."""


class SettingsInvalid(CarpusFault):
    """A settings file has an unknown key or a value out of range."""


class ChangedMeanwhile(CarpusFault):
    """Somebody else changed the same thing since it was read; ``subject`` is its table."""


class ChangeRefused(CarpusFault):
    """The clinic's server does not take a change that was made here; ``detail`` says why."""


class PseudonymGiven(CarpusFault):
    """A pseudonym was given twice while the server was away; the number ``detail`` was put behind the second one."""


class ServerGone(CarpusFault):
    """The clinic's server for records does not answer; what is changed waits for it."""


class NameUnsuited(CarpusFault):
    """A text cannot be a pseudonym or a name: it holds a sign that cannot be seen, or is too long."""


class DriverMissing(CarpusFault):
    """The library of a camera (OpenNI2, or its maker's) is not on this computer or cannot be loaded."""


class DriverFailed(CarpusFault):
    """The library of a camera died or no longer answers; it ran in a process of its own."""


class CameraUnknown(CarpusFault):
    """No kind of camera has this name."""


class CameraMissing(CarpusFault):
    """The driver sees no camera."""


class CameraBusy(CarpusFault):
    """Another program holds the camera."""


class CameraPermission(CarpusFault):
    """A camera is plugged in, but this user may not open it."""


class CameraUnsuited(CarpusFault):
    """The camera does not offer the pictures that Carpus needs."""


class CameraLost(CarpusFault):
    """The camera was unplugged or sends no more pictures. Told when it happens, raised when it does not come back."""


class OtherCamera(CameraLost):
    """Another camera is plugged in than the one that is wanted. Told while that one is away; raised at the opening."""


class CameraReturned(CarpusFault):
    """Told, never raised: the lost camera delivers again; ``detail`` is how long it was away."""


class RecordingDamaged(CarpusFault):
    """An .oni file whose structure is broken, so that the library could die on it or never end."""


class RecordingUnsupported(CarpusFault):
    """A sound recording, but of a kind of pictures that Carpus does not use."""


class PicturesLost(CarpusFault):
    """Told, never raised: damaged pictures of a recording were left out; ``detail`` counts them."""


class PicturesEnlarged(CarpusFault):
    """Told, never raised: pictures of one kind were smaller and have been enlarged."""


class IntrinsicsAssumed(CarpusFault):
    """Told, never raised: no camera file says how this camera sees, so ``detail`` is used in its place."""


class RegistrationAssumed(CarpusFault):
    """Told, never raised: nothing says whether depth lies on colour; it is taken as so."""


class DepthNotRegistered(CarpusFault):
    """Told, never raised: depth is known not to lie on colour, so depths are read beside the markers."""


class DiskTooSlow(CarpusFault):
    """Pictures came faster than they could be stored; what was stored is kept."""


class NotLookedBack(CarpusFault):
    """Told, never raised to a person: looking back at a live session failed or took too long; it is as tracked."""


class NotCorrectable(CarpusFault):
    """A session does not hold what correcting its markers needs."""


class NotCorrected(CarpusFault):
    """Tracking a session again with corrected markers did not come to its end; the old result is unchanged."""


class RegisterUnreadable(CarpusFault):
    """The register of patients cannot be opened, is damaged, or was written by a newer Carpus."""


class RegisterBusy(RegisterUnreadable):
    """Another program, mostly the window of Carpus, holds the list of patients."""


class RegisterDamaged(RegisterUnreadable):
    """The register's file is broken or not a register; reading it again does not help."""


class RegisterSetAside(CarpusFault):
    """Told, never raised: a damaged register was given another name, and the list made again from the sessions."""


class RegisterMissing(CarpusFault):
    """Told, never raised: there are sessions and no list of patients, so that one was made from them."""


class LogUnguarded(CarpusFault):
    """Told, never raised: what keeps the log from being changed had been taken out of the store."""


class FilesSetApart(CarpusFault):
    """Told, never raised: files among the sessions that are none; ``subject`` names some, ``detail`` counts them."""


class FolderGone(OutputNotWritable):
    """The folder of a running recording is no longer there."""


class DiskStalled(CarpusFault):
    """A disk that neither stores nor refuses; ``subject`` is the folder, ``detail`` for how long."""


class EndStalled(CarpusFault):
    """All of a recording is stored, but its disk stopped answering before the file was ended."""


class RecordingMoved(CarpusFault):
    """Told, never raised: a recording whose folder went away goes on at ``subject``; ``detail`` what stayed behind."""


class RecordingReturned(CarpusFault):
    """Told, never raised: a session that had to be recorded elsewhere is among the others now."""


class FolderMissing(CarpusFault):
    """There is no folder at the path where sessions were looked for."""


class FolderInUse(CarpusFault):
    """Another Carpus has the data folder open and does not answer."""


class SessionsMissing(CarpusFault):
    """A folder holds no session."""


class PatientUnknown(CarpusFault):
    """No patient has this pseudonym."""


class PseudonymTaken(CarpusFault):
    """Another patient of the register has this pseudonym."""


class ErasureUnfinished(CarpusFault):
    """Files of what was erased could not be deleted yet; ``subject`` names one, ``detail`` counts them."""


class ErasureLeadsOut(CarpusFault):
    """Nothing was erased: ``subject`` is a link on the way to what should go."""


class BackupPlaceUnsuited(CarpusFault):
    """The folder for back-ups cannot be one."""


class BackupIncomplete(CarpusFault):
    """Told after a back-up: ``subject`` is missing or cannot be read, and so are ``detail`` files in all."""


class PassphraseUnfit(CarpusFault):
    """What was typed cannot seal a file: ``detail`` says why."""


class SealRefused(CarpusFault):
    """A sealed file does not open: another passphrase, or damaged."""


class TooLargeToSeal(CarpusFault):
    """More than can be sealed as one file; ``detail`` says how much."""


class BackupUnequal(CarpusFault):
    """What is read back of a back-up is not what was written; ``subject`` begins the name of its content."""


class BackupUnreadable(CarpusFault):
    """The list of a back-up is damaged, or of a newer Carpus."""


class BackupMissing(CarpusFault):
    """There is no back-up in the folder."""


class BoardMissing(CarpusFault):
    """The printed board was seen in no picture."""


class BoardViewsAlike(CarpusFault):
    """The pictures of the board are too few, or too alike, to calibrate a camera."""


class BoardUnfit(CarpusFault):
    """The corners found are not those of a flat board: bent, blurred, or another board."""


class CardMissing(CarpusFault):
    """The check card, all six discs of it, was seen in too few pictures."""


class PinUncheckable(CarpusFault):
    """The part that compares a PIN with what is kept of it (argon2) is not installed or cannot be loaded."""
