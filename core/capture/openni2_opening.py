"""Opening a camera inside the capture process, and why it could not be opened."""

from __future__ import annotations

from collections.abc import Sequence

from carpus.core.capture.camera_plan import CameraPlan
from carpus.core.capture.capture_messages import Opened
from carpus.core.capture.capture_process import GaveUp
from carpus.core.capture.openni2 import CallFailed, Context, Device, DeviceProperty, Stream, StreamProperty
from carpus.core.capture.unseen_camera import why_unlisted
from carpus.core.capture.usb_devices import UsbCamera, usb_cameras
from carpus.core.capture.video_mode import PixelFormat, Sensor, VideoMode
from carpus.core.errors import CameraBusy, CameraMissing, CameraPermission, CameraUnsuited, DriverFailed


def open_camera(library: Context, plan: CameraPlan) -> tuple[Device, Opened]:
    """Open a live camera, start colour and depth, lay depth on colour."""
    if plan.uri:
        found = [plan.uri]
    else:
        known = {(int(vendor, 16), int(product, 16)) for vendor, product in plan.models}
        found = [each.uri for each in library.devices() if (each.vendor_id, each.product_id) in known]
        if not found:
            raise why_unlisted(usb_cameras(plan.models))
    device = _wanted(library, found, plan)
    streams: dict[Sensor, Stream] = {}
    for sensor, wanted in ((Sensor.COLOR, PixelFormat.RGB888), (Sensor.DEPTH, PixelFormat.DEPTH_1_MM)):
        mode = choose_mode(device.modes(sensor), wanted, plan.size_px, plan.fps)
        if mode is None:
            raise GaveUp(CameraUnsuited, f"no {wanted.name} pictures")
        stream = streams[sensor] = device.create_stream(sensor)
        if stream.mode() != mode and not stream.set_mode(mode):
            raise GaveUp(CameraUnsuited, f"{sensor.name.lower()} {mode}")
        stream.set_int(StreamProperty.MIRRORING, 0)
    automatic = [
        streams[Sensor.COLOR].set_int(key, 1)
        for key in (StreamProperty.AUTO_EXPOSURE, StreamProperty.AUTO_WHITE_BALANCE)
    ]
    for stream in streams.values():
        stream.start()
    # only a running depth stream takes it
    registered = device.can_register() and device.set_int(DeviceProperty.IMAGE_REGISTRATION, 1)
    synchronous = device.enable_sync()
    modes = {sensor: stream.mode() for sensor, stream in streams.items()}
    info = device.info()
    by_usb = plan.models.get((f"{info.vendor_id:04x}", f"{info.product_id:04x}"))
    settings = {
        "camera": by_usb or info.name or info.uri,
        "vendor": info.vendor,
        "uri": info.uri,
        "serial": device.text(DeviceProperty.SERIAL_NUMBER),
        "firmware": device.version(DeviceProperty.FIRMWARE_VERSION),
        "driver": device.version(DeviceProperty.DRIVER_VERSION),
        "library": f"OpenNI2 {library.version}",
        "color_mode": str(modes[Sensor.COLOR]),
        "depth_mode": str(modes[Sensor.DEPTH]),
        "registered": "by the camera" if registered else "no",
        "synchronous": "yes" if synchronous else "no",
        "automatic_exposure": "on" if all(automatic) else "not settable",
    }
    across, down = (
        streams[Sensor.COLOR].get_float(key) for key in (StreamProperty.HORIZONTAL_FOV, StreamProperty.VERTICAL_FOV)
    )
    view = (across, down) if across and down else None
    mirrored = {sensor: bool(stream.get_int(StreamProperty.MIRRORING)) for sensor, stream in streams.items()}
    return device, Opened(modes, mirrored, view, {key: value for key, value in settings.items() if value})


def _wanted(library: Context, uris: Sequence[str], plan: CameraPlan) -> Device:
    """The first of these, or the one with the plan's serial number: only an open device tells it."""
    others = []
    for uri in uris:
        try:
            device = library.open(uri)
        except CallFailed as failure:
            raise _why_not_opened(failure, usb_cameras(plan.models)) from failure
        serial = device.text(DeviceProperty.SERIAL_NUMBER)
        if not plan.serial or serial == plan.serial:
            return device
        others.append(f"{device.info().name} {serial}".strip())
        device.close()
    raise why_unlisted((), others)


def choose_mode(
    modes: Sequence[VideoMode], pixel_format: PixelFormat, size_px: tuple[int, int], fps: int
) -> VideoMode | None:
    """The mode of this format nearest to what is wanted: same size and rate, else the largest that is not larger.

    >>> offered = [VideoMode(200, 320, 240, 60), VideoMode(200, 320, 240, 30), VideoMode(200, 1280, 1024, 30)]
    >>> choose_mode(offered, PixelFormat.RGB888, (640, 480), 30)
    VideoMode(pixel_format=200, width_px=320, height_px=240, fps=30)
    """
    width, height = size_px
    fitting = [
        mode
        for mode in modes
        if mode.pixel_format == pixel_format and mode.width_px <= width and mode.height_px <= height
    ]
    return max(fitting, key=lambda mode: (mode.width_px * mode.height_px, -abs(mode.fps - fps)), default=None)


def _why_not_opened(failure: CallFailed, seen: Sequence[UsbCamera]) -> GaveUp:
    if any(not camera.may_open for camera in seen):
        return GaveUp(CameraPermission, str(next(camera.node for camera in seen if not camera.may_open)))
    if any(camera.is_claimed for camera in seen) or "USB interface" in failure.reason:
        return GaveUp(CameraBusy, failure.reason)
    return GaveUp(CameraMissing if not seen else DriverFailed, failure.reason)
