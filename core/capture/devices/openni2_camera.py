"""Asus Xtion and other PrimeSense cameras, by OpenNI2."""

from __future__ import annotations

import ctypes
import sys
import threading
from collections.abc import Sequence

from carpus.core.capture.devices.cameras import CameraKind, UsbCamera, camera_unlisted_error, find_usb_cameras
from carpus.core.capture.devices.capture_process import (
    FPS,
    POLL_MS,
    SIZE_PX,
    CameraConfig,
    CaptureChannel,
    DeviceOpened,
)
from carpus.core.capture.devices.openni2 import (
    Context,
    Device,
    DeviceProperty,
    OpenNI2Error,
    Stream,
    StreamProperty,
    VideoFrame,
    library_version,
    load_library,
)
from carpus.core.capture.source import PixelFormat, Sensor, VideoMode
from carpus.core.model import errors
from carpus.core.model.depth_sensor import PRIMESENSE
from carpus.core.model.errors import CarpusFault
from carpus.core.model.installation import Finding
from carpus.core.model.phrase import phrase
from carpus.core.platform.child_process import ChildDiedError, call_in_child

MODELS = {
    ("1d27", "0500"): "PrimeSense Carmine",
    ("1d27", "0600"): "Asus Xtion Pro Live",
    ("1d27", "0601"): "Asus Xtion Pro Live",
    ("1d27", "0609"): "PrimeSense Carmine 1.09",
}
AUTOMATIC = (StreamProperty.AUTO_EXPOSURE, StreamProperty.AUTO_WHITE_BALANCE)


def open_camera(library: Context, plan: CameraConfig) -> tuple[Device, DeviceOpened]:
    """Open a live camera, start colour and depth, register depth to colour."""
    device = _find_device(library, plan)
    streams: dict[Sensor, Stream] = {}
    for sensor, wanted in ((Sensor.COLOR, PixelFormat.RGB888), (Sensor.DEPTH, PixelFormat.DEPTH_1_MM)):
        mode = choose_mode(device.list_modes(sensor), wanted, SIZE_PX, FPS)
        if mode is None:
            raise errors.CameraUnsuited("", f"no {wanted.name} images")
        stream = streams[sensor] = device.create_stream(sensor)
        if stream.read_mode() != mode and not stream.set_mode(mode):
            raise errors.CameraUnsuited("", f"{sensor.name.lower()} {mode}")
        stream.set_int(StreamProperty.MIRRORING, 0)
    automatic = [streams[Sensor.COLOR].set_int(key, 1) for key in AUTOMATIC]
    for stream in streams.values():
        stream.start()
    # only a running depth stream takes it
    registered = device.can_register_depth() and device.set_value(DeviceProperty.IMAGE_REGISTRATION, ctypes.c_int(1))
    synchronous = device.enable_sync()
    modes = {sensor: stream.read_mode() for sensor, stream in streams.items()}
    info = device.read_info()
    by_usb = plan.models.get((f"{info.vendor_id:04x}", f"{info.product_id:04x}"))
    settings = {
        "camera": by_usb or info.name or info.uri,
        "vendor": info.vendor,
        "uri": info.uri,
        "serial": device.read_text(DeviceProperty.SERIAL_NUMBER),
        "firmware": device.read_version(DeviceProperty.FIRMWARE_VERSION),
        "driver": device.read_version(DeviceProperty.DRIVER_VERSION),
        "library": f"OpenNI2 {library.version}",
        "color_mode": str(modes[Sensor.COLOR]),
        "depth_mode": str(modes[Sensor.DEPTH]),
        "registered": "by the camera" if registered else "no",
        "synchronous": "yes" if synchronous else "no",
        "automatic_exposure": "on" if all(automatic) else "not settable",
    }
    across, down = (
        streams[Sensor.COLOR].get_value(key, ctypes.c_float())
        for key in (StreamProperty.HORIZONTAL_FOV, StreamProperty.VERTICAL_FOV)
    )
    view = (across, down) if across and down else None
    mirrored = frozenset(
        sensor for sensor, stream in streams.items() if stream.get_value(StreamProperty.MIRRORING, ctypes.c_int())
    )
    known = {key: value for key, value in settings.items() if value}
    return device, DeviceOpened(modes, known, mirrored=mirrored, field_of_view_rad=view)


def _find_device(library: Context, plan: CameraConfig) -> Device:
    """Open the device at the configured address, else the first of its models with the wanted serial number.

    Only an open device states its serial number.
    """
    if plan.uri:
        found = [plan.uri]
    else:
        known = {(int(vendor, 16), int(product, 16)) for vendor, product in plan.models}
        found = [each.uri for each in library.list_devices() if (each.vendor_id, each.product_id) in known]
        if not found:
            raise camera_unlisted_error(find_usb_cameras(plan.models))
    others = []
    for uri in found:
        try:
            device = library.open(uri)
        except OpenNI2Error as failure:
            raise _open_error(failure, find_usb_cameras(plan.models)) from failure
        serial = device.read_text(DeviceProperty.SERIAL_NUMBER)
        if not plan.serial or serial == plan.serial:
            return device
        others.append(f"{device.read_info().name} {serial}".strip())
        device.close()
    raise camera_unlisted_error((), others)


def choose_mode(
    modes: Sequence[VideoMode], pixel_format: PixelFormat, size_px: tuple[int, int], fps: int
) -> VideoMode | None:
    """Return the mode of a pixel format nearest to the wanted size and rate, but not larger; None if there is none.

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


def _open_error(failure: OpenNI2Error, seen: Sequence[UsbCamera]) -> CarpusFault:
    locked = [str(camera.node) for camera in seen if not camera.can_open]
    if locked:
        return errors.CameraPermission("", locked[0])
    if any(camera.is_claimed for camera in seen) or "USB interface" in failure.reason:
        return errors.CameraBusy("", failure.reason)
    return (errors.DriverFailed if seen else errors.CameraMissing)("", failure.reason)


BYTES_PER_PIXEL: dict[int, int] = {PixelFormat.RGB888: 3, PixelFormat.DEPTH_1_MM: 2, PixelFormat.DEPTH_100_UM: 2}


def serve(channel: CaptureChannel, plan: CameraConfig) -> None:
    """Serve a camera in the capture process."""
    try:
        _serve(channel, plan)
    except OpenNI2Error as failure:
        raise errors.DriverFailed("", f"{failure.call}: {failure.reason}") from failure


def _serve(channel: CaptureChannel, plan: CameraConfig) -> None:
    library, unplugged = Context(), threading.Event()
    device, opened = open_camera(library, plan)
    uri = device.read_info().uri
    library.register_disconnect_handler(lambda gone: unplugged.set() if gone == uri else None)
    channel.retain(library, unplugged)
    streams = list(device.streams)

    def forward_images() -> None:
        if library.poll_streams(streams, POLL_MS) is not None:
            # the wait names the older stream; reading only that one would starve the other
            for stream in streams:
                if library.poll_streams([stream], 0) is None:
                    continue
                with stream.read_frame() as frame:
                    size = None if frame is None else frame_size_bytes(frame, opened.modes[stream.sensor])
                    if frame is not None and size is not None:
                        pixels = memoryview((ctypes.c_ubyte * size).from_address(frame.address)).cast("B")
                        channel.publish(stream.sensor, frame.index, frame.timestamp_us, pixels)
                channel.note_image(stream.sensor)

    color = next(stream for stream in streams if stream.sensor == Sensor.COLOR)
    channel.lock_exposure = lambda: sum(color.set_int(key, 0) for key in AUTOMATIC) == len(AUTOMATIC)
    channel.send(opened)
    try:
        channel.run(opened.modes, unplugged, forward_images)
    finally:
        device.close()


def frame_size_bytes(frame: VideoFrame, mode: VideoMode) -> int | None:
    """Return the bytes that may be read of an image; None if it does not match the mode of its stream.

    A driver may announce any width and height with any number of bytes behind them.
    """
    row = mode.width_px * BYTES_PER_PIXEL.get(mode.pixel_format, 0)
    size = row * mode.height_px
    stated = (frame.mode.pixel_format, frame.width_px, frame.height_px, frame.stride_bytes, frame.size_bytes)
    agreed = stated == (mode.pixel_format, mode.width_px, mode.height_px, row, size)
    return size if agreed and size > 0 and frame.address and not frame.is_cropped else None


def check_driver(loads_library: bool, _is_needed: bool) -> Finding:
    """Check the OpenNI2 library; asking its version takes half a second in a process of its own."""
    try:
        load_library()
    except errors.DriverMissing as fault:
        remedy = (
            phrase("Run: sudo apt-get install libopenni2-0")
            if sys.platform.startswith("linux")
            else phrase("Install OpenNI2 from the camera’s manufacturer, then restart Carpus.")
        )
        remedy = phrase("Needed for live cameras. {remedy}", remedy=remedy)
        return Finding(phrase("Driver"), "bad", fault.detail or "not found", remedy)
    if not loads_library:
        return Finding(phrase("Driver"), "good", phrase("OpenNI2"))
    try:
        version = call_in_child(library_version)
    except ChildDiedError:
        found = phrase("OpenNI2 stops when its version is queried")
        return Finding(phrase("Driver"), "bad", found, phrase("Reinstall OpenNI2."))
    return Finding(phrase("Driver"), "good", phrase("OpenNI2 {value}", value=version))


KIND = CameraKind(
    title="Asus Xtion",
    models=MODELS,
    serve=serve,
    find_sensor=lambda _settings, _focal_px: PRIMESENSE,
    check_driver=check_driver,
    needed_mbit=480,
    port_advice=phrase("The camera needs a USB 2 port: some USB 3 ports refuse cameras with old firmware."),
)
