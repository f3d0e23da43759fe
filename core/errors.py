"""What can go wrong, as facts. The words for each kind are in :mod:`core.words`."""

from __future__ import annotations

from pathlib import Path


class CarpusFault(Exception):
    """Something the person at the desk must be told; carries facts, no prose.

    ``subject`` is the file, folder, device or marker concerned; ``detail`` the measured fact
    (a number, a name, a line). Neither ever holds a patient's name.
    """

    def __init__(self, subject: str | Path = "", detail: str = "") -> None:
        super().__init__(f"{type(self).__name__}: {subject} {detail}".strip())
        self.subject = str(subject)
        self.detail = detail


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


class OutputNotWritable(CarpusFault):
    """The output's folder cannot be written to."""


class DiskFull(CarpusFault):
    """No room was left while writing; what was written is kept."""


class SessionUnreadable(CarpusFault):
    """A file is not a session that this version reads."""


class SettingsInvalid(CarpusFault):
    """A settings file has an unknown key or a value out of range."""


class DriverMissing(CarpusFault):
    """The OpenNI2 library is not on this computer or cannot be loaded."""


class DriverFailed(CarpusFault):
    """The OpenNI2 library died or no longer answers; it ran in a process of its own."""


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


class RegisterUnreadable(CarpusFault):
    """The register of patients cannot be opened, is damaged, or was written by a newer Carpus."""


class FolderMissing(CarpusFault):
    """There is no folder at the path where sessions were looked for."""


class FolderInUse(CarpusFault):
    """Another Carpus has the data folder open and does not answer."""


class PseudonymTaken(CarpusFault):
    """Another patient of the register has this pseudonym."""
