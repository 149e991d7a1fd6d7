# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Scene and camera: what include/tofray/scene.h and camera.h hold. Written by python/tools/make_model.py; do not edit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

from ._pinhole import PinholeMethods
from ._pose import PlacementMethods, PoseMethods
from ._record import Record

if TYPE_CHECKING:
    from typing import Literal

    from ._native import MeshMotion, ReflectivityMap, TriangleMesh, VectorMap


class PixelMask(Record):
    """Where within a pixel light is collected, for samples within it (SimulatorOptions::subpixel).

    Attributes
    ----------
    kind : Literal["square", "table"]
        square: evenly in a square of area fill_factor·pitch² in its middle.
    samples : list[float], 1
        table: sensitivity over the whole pixel, any unit; row by row from the top. From 0 to 1e12.
    columns : int
        From 1 to 1024.
    rows : int
        From 1 to 1024.
    """
    __slots__ = ("kind", "samples", "columns", "rows")
    kind: Literal["square", "table"]
    samples: list[float]
    columns: int
    rows: int

    def __init__(
        self,
        *,
        kind: Literal["square", "table"] = 'square',
        samples: Sequence[float] = (),
        columns: int = 0,
        rows: int = 0,
    ) -> None:
        self.kind = kind
        self.samples = list(samples)
        self.columns = columns
        self.rows = rows


class Sensor(Record):
    """The pixel array.

    Attributes
    ----------
    width : int
        Columns of pixels. From 1 to 16384.
    height : int
        Rows of pixels. From 1 to 16384.
    pixel_pitch_m : float, m
        Distance between the centres of neighbouring pixels. From 5e-7 to 0.001.
    fill_factor : float, 1
        Share of the pixel's area that collects light. From 0.001 to 1.
    mask : PixelMask
        Where within a pixel light is collected, for several samples per pixel.
    """
    __slots__ = ("width", "height", "pixel_pitch_m", "fill_factor", "mask")
    width: int
    height: int
    pixel_pitch_m: float
    fill_factor: float
    mask: PixelMask

    def __init__(
        self,
        *,
        width: int = 0,
        height: int = 0,
        pixel_pitch_m: float = 0.0,
        fill_factor: float = 1.0,
        mask: PixelMask | None = None,
    ) -> None:
        self.width = width
        self.height = height
        self.pixel_pitch_m = pixel_pitch_m
        self.fill_factor = fill_factor
        self.mask = PixelMask() if mask is None else mask


class Curve(Record):
    """A function of one variable given by samples; a not-a-knot cubic spline goes through them,
    limited so that it turns only at samples.

    Attributes
    ----------
    x : list[float], any unit
        Ascending.
    y : list[float], any unit
        One for each.
    """
    __slots__ = ("x", "y")
    x: list[float]
    y: list[float]

    def __init__(
        self,
        *,
        x: Sequence[float] = (),
        y: Sequence[float] = (),
    ) -> None:
        self.x = list(x)
        self.y = list(y)


class Scatter(Record):
    """Light that lens and filter scatter over the sensor before it is collected: (1 − share)·δ +
    share·K, ΣK = 1.

    Attributes
    ----------
    kind : Literal["none", "gaussians", "kernel"]
    share : float, 1
        gaussians, kernel: share of the light that is scattered. From 0 to 1.
    sigma_px : list[float], px
        gaussians: width of each Gaussian. From 0.1 to 10000.
    weights : list[float], 1
        gaussians: weight of each Gaussian, any unit; in files equal unless given. gaussians: weight
        of each, any unit; empty: equal. From 0 to 1e12.
    kernel : list[float], 1
        kernel: weights of the kernel, any unit: row by row from the top; rows and columns odd in
        number; the middle is the pixel itself. From 0 to 1e12.
    columns : int
        From 1 to 255.
    rows : int
        From 1 to 255.
    """
    __slots__ = ("kind", "share", "sigma_px", "weights", "kernel", "columns", "rows")
    kind: Literal["none", "gaussians", "kernel"]
    share: float
    sigma_px: list[float]
    weights: list[float]
    kernel: list[float]
    columns: int
    rows: int

    def __init__(
        self,
        *,
        kind: Literal["none", "gaussians", "kernel"] = 'none',
        share: float = 0.0,
        sigma_px: Sequence[float] = (),
        weights: Sequence[float] = (),
        kernel: Sequence[float] = (),
        columns: int = 0,
        rows: int = 0,
    ) -> None:
        self.kind = kind
        self.share = share
        self.sigma_px = list(sigma_px)
        self.weights = list(weights)
        self.kernel = list(kernel)
        self.columns = columns
        self.rows = rows


class Lens(Record):
    """Pinhole with distortion, OpenCV's conventions (theory 1); pixel (0,0)'s centre is at (0.0, 0.0).

    Attributes
    ----------
    fx_px : float, px
        Focal length over pixel pitch, along a row. From 1 to 1e6.
    fy_px : float, px
        Focal length over pixel pitch, along a column. From 1 to 1e6.
    cx_px : float, px
        Column of the principal point; the centre of pixel (0, 0) is at (0, 0). From -100000 to
        100000.
    cy_px : float, px
        Row of the principal point; the centre of pixel (0, 0) is at (0, 0). From -100000 to 100000.
    distortion : Literal["brown_conrady", "fisheye"]
        As in OpenCV: brown_conrady: k1 to k6, p1 and p2, rational from k4 on; fisheye: k1 to k4
        over the angle to the axis.
    k1 : float, 1
        As in OpenCV: radial coefficient of r^2; fisheye: of angle^2. From -1000 to 1000.
    k2 : float, 1
        As in OpenCV: radial coefficient of r^4; fisheye: of angle^4. From -1000 to 1000.
    p1 : float, 1
        brown_conrady: as in OpenCV: first tangential coefficient. From -1000 to 1000.
    p2 : float, 1
        brown_conrady: as in OpenCV: second tangential coefficient. From -1000 to 1000.
    k3 : float, 1
        As in OpenCV: radial coefficient of r^6; fisheye: of angle^6. From -1000 to 1000.
    k4 : float, 1
        As in OpenCV: radial coefficient of r^2 in the denominator; fisheye: of angle^8. From -1000
        to 1000.
    k5 : float, 1
        brown_conrady: as in OpenCV: radial coefficient of r^4 in the denominator. From -1000 to
        1000.
    k6 : float, 1
        brown_conrady: as in OpenCV: radial coefficient of r^6 in the denominator. From -1000 to
        1000.
    f_number : float, 1
        N: focal length over the diameter of the entrance pupil. From 0.3 to 100.
    transmission : float, 1
        Transmission of lens and filter at the illumination wavelength. From 0 to 1.
    vignetting : Literal["cos4", "off", "table"]
        Fall-off toward the corners: cos4, off, or a table over the angle to the axis.
    vignetting_table : Curve
        Angle to the optical axis [rad] → factor. x: angle from 0 to 1.5708 rad, y: factor from 0 to
        2.
    scatter : Scatter
        Light that lens and filter scatter over the sensor.
    """
    __slots__ = ("fx_px", "fy_px", "cx_px", "cy_px", "distortion", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "f_number",
                 "transmission", "vignetting", "vignetting_table", "scatter")
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    distortion: Literal["brown_conrady", "fisheye"]
    k1: float
    k2: float
    p1: float
    p2: float
    k3: float
    k4: float
    k5: float
    k6: float
    f_number: float
    transmission: float
    vignetting: Literal["cos4", "off", "table"]
    vignetting_table: Curve
    scatter: Scatter

    def __init__(
        self,
        *,
        fx_px: float = 0.0,
        fy_px: float = 0.0,
        cx_px: float = 0.0,
        cy_px: float = 0.0,
        distortion: Literal["brown_conrady", "fisheye"] = 'brown_conrady',
        k1: float = 0.0,
        k2: float = 0.0,
        p1: float = 0.0,
        p2: float = 0.0,
        k3: float = 0.0,
        k4: float = 0.0,
        k5: float = 0.0,
        k6: float = 0.0,
        f_number: float = 1.0,
        transmission: float = 1.0,
        vignetting: Literal["cos4", "off", "table"] = 'cos4',
        vignetting_table: Curve | None = None,
        scatter: Scatter | None = None,
    ) -> None:
        self.fx_px = fx_px
        self.fy_px = fy_px
        self.cx_px = cx_px
        self.cy_px = cy_px
        self.distortion = distortion
        self.k1 = k1
        self.k2 = k2
        self.p1 = p1
        self.p2 = p2
        self.k3 = k3
        self.k4 = k4
        self.k5 = k5
        self.k6 = k6
        self.f_number = f_number
        self.transmission = transmission
        self.vignetting = vignetting
        self.vignetting_table = Curve() if vignetting_table is None else vignetting_table
        self.scatter = Scatter() if scatter is None else scatter


class Filter(Record):
    """Optical filter before the sensor, for ambient light only (the camera's illumination has
    Lens::transmission).

    Attributes
    ----------
    center_m : float, m
        Centre of the pass band; in files the illumination wavelength of the first light unless
        given. From 1e-7 to 2e-5.
    half_width_m : float, m
        Half width of the pass band: center - half_width_m to center + half_width_m. From 1e-10 to
        1e-5.
    peak : float, 1
        Transmission of the filter in its pass band. From 0 to 1.
    table : Curve
        A table in place of center, half_width_m and peak. x: wavelength from 1e-7 to 2e-5 m, y:
        transmission from 0 to 1.
    """
    __slots__ = ("center_m", "half_width_m", "peak", "table")
    center_m: float
    half_width_m: float
    peak: float
    table: Curve

    def __init__(
        self,
        *,
        center_m: float = 8.5e-07,
        half_width_m: float = 1.5e-08,
        peak: float = 1.0,
        table: Curve | None = None,
    ) -> None:
        self.center_m = center_m
        self.half_width_m = half_width_m
        self.peak = peak
        self.table = Curve() if table is None else table


class Area(Record):
    """Where the light of a source comes out: at a point, or evenly all over a disk or rectangle across
    its axis. So many points at fixed places stand for that, in equal shares (theory 2.1).

    Attributes
    ----------
    kind : Literal["none", "disk", "rectangle"]
    radius_m : float, m
        disk: radius of the disk, which lies across the axis. From 1e-6 to 10.
    width_m : float, m
        rectangle: width along the camera's x; along its y where the axis is along x. From 1e-6 to
        10.
    height_m : float, m
        rectangle: height, across the width and the axis. From 1e-6 to 10.
    points : int
        disk, rectangle: number of points that stand for the area; each costs as much as a light
        source. From 1 to 64.
    """
    __slots__ = ("kind", "radius_m", "width_m", "height_m", "points")
    kind: Literal["none", "disk", "rectangle"]
    radius_m: float
    width_m: float
    height_m: float
    points: int

    def __init__(
        self,
        *,
        kind: Literal["none", "disk", "rectangle"] = 'none',
        radius_m: float = 0.0,
        width_m: float = 0.0,
        height_m: float = 0.0,
        points: int = 16,
    ) -> None:
        self.kind = kind
        self.radius_m = radius_m
        self.width_m = width_m
        self.height_m = height_m
        self.points = points


class Pattern(Record):
    """How light of one source is spread over directions; integral over the sphere is 1 (theory 2.1).

    Attributes
    ----------
    kind : Literal["cone", "lambertian", "cosine_lobe", "flat_top", "table"]
    half_angle_rad : float, rad
        cone: half angle of the cone, within which it is uniform. From 0.001 to 3.14159.
    exponent : float, 1
        cosine_lobe: n of cos^n. From 0 to 10000.
    width_rad : float, rad
        flat_top: full width across x at half the peak. From 0.001 to 6.28319.
    height_rad : float, rad
        flat_top: full width across y at half the peak. From 0.001 to 6.28319.
    columns : int
        flat_top: columns of the grid that power_model paper_literal reads. From 2 to 4096.
    rows : int
        flat_top: rows of the grid that power_model paper_literal reads. From 2 to 4096.
    half_range_x_rad : float, rad
        flat_top: half range across x, beyond which it is dark; in files the width unless given.
        table: half range of the table across its columns. The grid covers ±this across its columns
        (edges of the outer cells); beyond, the light is dark. Of a flat top, 0 takes its width,
        where the light has fallen to nothing (2⁻²⁵⁶). From 0.001 to 6.28319.
    half_range_y_rad : float, rad
        flat_top: half range across y, beyond which it is dark; in files the height unless given.
        table: half range of the table across its rows. Half range across its rows; 0: the height.
        From 0.001 to 6.28319.
    samples : list[float], 1
        table: rows (from -half_range_y_rad on) of samples (from -half_range_x_rad on), any unit.
        From 0 to 1e12.
    """
    __slots__ = ("kind", "half_angle_rad", "exponent", "width_rad", "height_rad", "columns", "rows", "half_range_x_rad",
                 "half_range_y_rad", "samples")
    kind: Literal["cone", "lambertian", "cosine_lobe", "flat_top", "table"]
    half_angle_rad: float
    exponent: float
    width_rad: float
    height_rad: float
    columns: int
    rows: int
    half_range_x_rad: float
    half_range_y_rad: float
    samples: list[float]

    def __init__(
        self,
        *,
        kind: Literal["cone", "lambertian", "cosine_lobe", "flat_top", "table"] = 'lambertian',
        half_angle_rad: float = 0.0,
        exponent: float = 1.0,
        width_rad: float = 0.0,
        height_rad: float = 0.0,
        columns: int = 0,
        rows: int = 0,
        half_range_x_rad: float = 0.0,
        half_range_y_rad: float = 0.0,
        samples: Sequence[float] = (),
    ) -> None:
        self.kind = kind
        self.half_angle_rad = half_angle_rad
        self.exponent = exponent
        self.width_rad = width_rad
        self.height_rad = height_rad
        self.columns = columns
        self.rows = rows
        self.half_range_x_rad = half_range_x_rad
        self.half_range_y_rad = half_range_y_rad
        self.samples = list(samples)


class Waveform(Record):
    """Light modulation over one period (theory 3).

    Attributes
    ----------
    kind : Literal["rectangular", "sine", "measured", "trapezoid", "gaussian", "emission"]
    duty : float, 1
        rectangular, trapezoid: pulse width at half height over the period. From 0.001 to 0.999.
    rise_time_s : float, s
        rectangular, trapezoid: rise time of a linear edge, 0 to 100 %. From 0 to 0.001.
    bandwidth_hz : float, Hz
        rectangular, sine, trapezoid, gaussian, emission: single pole of the light source; 0: none.
        From 0 to 1e12.
    jitter_s : float, s
        rectangular, sine, trapezoid, gaussian, emission: Gaussian jitter of the light's edges, 1
        sigma. From 0 to 1e-6.
    harmonics : int
        rectangular, measured, trapezoid, gaussian, emission: number of odd harmonics that are kept:
        1, 3, 5, 7 …. From 1 to 8.
    modulation_depth : float, 1
        sine: modulation depth d of the light 1 + d cos. From 0.001 to 1.
    correlation : list[float], 1
        measured: (A-B)/(A+B) at reference phases over one period, light and pixel at no distance.
        From -10 to 10.
    fall_time_s : float, s
        trapezoid: fall time of the linear edge at the pulse's end. From 0 to 0.001.
    sigma_s : float, s
        gaussian: width of the pulse, 1 sigma. From 0 to 0.001.
    emission : list[float], 1
        emission: the light over one period, any unit, from the middle of the pulse on. From 0 to
        1e12.
    sample_phases_rad : list[float], rad
        measured, emission: phases of the samples, ascending; in files equally spaced from 0 unless
        given. Measured, emission: at which phases of the period the samples are, ascending within
        one turn; empty: equally spaced from 0 on. From -100 to 100.
    """
    __slots__ = ("kind", "duty", "rise_time_s", "bandwidth_hz", "jitter_s", "harmonics", "modulation_depth", "correlation",
                 "fall_time_s", "sigma_s", "emission", "sample_phases_rad")
    kind: Literal["rectangular", "sine", "measured", "trapezoid", "gaussian", "emission"]
    duty: float
    rise_time_s: float
    bandwidth_hz: float
    jitter_s: float
    harmonics: int
    modulation_depth: float
    correlation: list[float]
    fall_time_s: float
    sigma_s: float
    emission: list[float]
    sample_phases_rad: list[float]

    def __init__(
        self,
        *,
        kind: Literal["rectangular", "sine", "measured", "trapezoid", "gaussian", "emission"] = 'rectangular',
        duty: float = 0.5,
        rise_time_s: float = 0.0,
        bandwidth_hz: float = 0.0,
        jitter_s: float = 0.0,
        harmonics: int = 4,
        modulation_depth: float = 1.0,
        correlation: Sequence[float] = (),
        fall_time_s: float = 0.0,
        sigma_s: float = 0.0,
        emission: Sequence[float] = (),
        sample_phases_rad: Sequence[float] = (),
    ) -> None:
        self.kind = kind
        self.duty = duty
        self.rise_time_s = rise_time_s
        self.bandwidth_hz = bandwidth_hz
        self.jitter_s = jitter_s
        self.harmonics = harmonics
        self.modulation_depth = modulation_depth
        self.correlation = list(correlation)
        self.fall_time_s = fall_time_s
        self.sigma_s = sigma_s
        self.emission = list(emission)
        self.sample_phases_rad = list(sample_phases_rad)


class Illumination(Record):
    """One of the camera's light sources, in the camera frame.

    Attributes
    ----------
    position : tuple[float, float, float], m
        Position of the light source in the camera's frame. From -100 to 100.
    axis : tuple[float, float, float], 1
        Direction in which the light source shines, in the camera's frame. From -1e6 to 1e6.
    illumination_wavelength_m : float, m
        Wavelength of the light source. From 3e-7 to 2e-6.
    power_w : float, W
        Optical power during a lit raw frame, mean over the modulation period. From 0 to 10000.
    ring_leds : int
        Number of sources on a circle about the position, across the axis. From 1 to 64.
    ring_radius_m : float, m
        Radius of the circle of ring_leds. From 0 to 10.
    area : Area
        A disk or rectangle across the axis that shines evenly, in place of a point.
    pattern : Pattern
        How the light is spread over directions.
    waveform : Waveform
        How the light is modulated.
    """
    __slots__ = ("position", "axis", "illumination_wavelength_m", "power_w", "ring_leds", "ring_radius_m", "area", "pattern",
                 "waveform")
    position: tuple[float, float, float]
    axis: tuple[float, float, float]
    illumination_wavelength_m: float
    power_w: float
    ring_leds: int
    ring_radius_m: float
    area: Area
    pattern: Pattern
    waveform: Waveform

    def __init__(
        self,
        *,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        axis: tuple[float, float, float] = (0.0, 0.0, 1.0),
        illumination_wavelength_m: float = 8.5e-07,
        power_w: float = 0.0,
        ring_leds: int = 1,
        ring_radius_m: float = 0.0,
        area: Area | None = None,
        pattern: Pattern | None = None,
        waveform: Waveform | None = None,
    ) -> None:
        self.position = position
        self.axis = axis
        self.illumination_wavelength_m = illumination_wavelength_m
        self.power_w = power_w
        self.ring_leds = ring_leds
        self.ring_radius_m = ring_radius_m
        self.area = Area() if area is None else area
        self.pattern = Pattern() if pattern is None else pattern
        self.waveform = Waveform() if waveform is None else waveform


class Pixel(Record):
    """The two-tap pixel (theory 3). Electrons per tap where nothing else is said.

    Attributes
    ----------
    quantum_efficiency : Curve
        Electrons per photon, by wavelength. x: wavelength from 1e-7 to 2e-5 m, y: value from 0 to
        1.
    contrast : Curve
        Demodulation contrast of the pixel itself; in files 1 unless given. Modulation frequency
        [Hz] → K; one sample: a constant. x: modulation frequency from 1000 to 1e10 Hz, y: value
        from 0 to 1.
    contrast_by_wavelength : Curve
        Factor on the contrast at the wavelength of each light; in files 1 unless given; not applied
        to a measured waveform, which contains it. Wavelength [m] → factor on K; none: 1. x:
        wavelength from 1e-7 to 2e-5 m, y: factor from 0 to 10.
    bandwidth_hz : float, Hz
        Single pole of the gate; 0: none. From 0 to 1e12.
    full_well_e : float, e
        Full-well capacity of a tap. From 1 to 1e30.
    read_noise_e : float, e
        Noise of reset and readout per tap, 1 sigma; reset noise alone may stand in reset_noise.
        From 0 to 1e6.
    column_noise_e : float, e
        Noise of A-B that all pixels of a column share, drawn for each raw frame, 1 sigma. From 0 to
        1e6.
    row_noise_e : float, e
        Noise of A-B that all pixels of a row share, drawn for each raw frame, 1 sigma. From 0 to
        1e6.
    dark_current_e_per_s : float, e/s
        Dark current per tap at the camera's reference temperature. From 0 to 1e12.
    dark_current_doubling_k : float, K
        Temperature rise that doubles the dark current; 0: it is constant. From 0 to 1000.
    tap_gain_mismatch : float, 1
        Mismatch of taps A and B, the same in all pixels: g: tap A collects 1 + g/2 of its charge,
        tap B 1 - g/2. From -1 to 1.
    tap_offset_mismatch_e : float, e
        Mismatch of taps A and B, the same in all pixels: offset of tap A less that of tap B in each
        raw frame: half of it more in A, half of it less in B. From -1e6 to 1e6.
    crosstalk_left_right : float, 1
        crosstalk: charge that neighbours collect: share of a pixel's charge that each of the
        neighbours left and right collects. From 0 to 0.25.
    crosstalk_up_down : float, 1
        crosstalk: charge that neighbours collect: share of a pixel's charge that each of the
        neighbours above and below collects. From 0 to 0.25.
    nonlinearity : Curve
        Charge that is read for each charge of a tap, rising from 0 e; in files the charge itself
        unless given. Charge of a tap [e⁻] → charge that is read of it; none: the same. x: charge
        from 0 to 1e12 e, y: read from 0 to 1e12 e.
    prnu : float, 1
        Fixed patterns: differences between pixels: photo response non-uniformity, 1 sigma. From 0
        to 1.
    dsnu_dn : float, DN
        Fixed patterns: differences between pixels: offset pattern, 1 sigma. From 0 to 10000.
    delay_s : float, s
        Fixed patterns: differences between pixels: fixed delay per pixel, 1 sigma. From 0 to 1e-6.
    phase_offset_rad : float, rad
        Fixed patterns: differences between pixels: fixed phase per pixel and modulation frequency,
        1 sigma. From 0 to 6.28319.
    pattern_seed : int
        Fixed patterns: differences between pixels: seed of the fixed patterns: which specimen of
        the sensor. From 0 to 9007199254740991.
    suppression_threshold_e : float, e
        Background suppression: charge of the smaller tap at which suppression starts; 0: no
        suppression. From 0 to 1e12.
    suppression_budget_e : float, e
        Background suppression: largest charge taken off each tap. From 0 to 1e12.
    suppression_noise_factor : float, 1
        Background suppression: factor on the noise of removed charge: charge x adds a variance of
        suppression_noise_factor^2 x to its tap. From 0 to 100.
    reset_noise_e : float, e
        Random charge that the reset leaves in a tap: reset noise per tap at the camera's reference
        temperature, 1 sigma, in addition to read_noise_e. From 0 to 1e6.
    cancels_reset_noise : bool
        Random charge that the reset leaves in a tap: correlated double sampling: no reset noise,
        but each tap is read twice.
    blooming_share : float, 1
        blooming: charge above full well, which spills into neighbours: share of the charge above
        full well that each of the four neighbours receives. From 0 to 0.25.
    blooming_limit_e : float, e
        blooming: charge above full well, which spills into neighbours: a pixel that receives more
        than this from its neighbours in a lit raw frame is flagged as saturated. From 0 to 1e12.
    """
    __slots__ = ("quantum_efficiency", "contrast", "contrast_by_wavelength", "bandwidth_hz", "full_well_e", "read_noise_e",
                 "column_noise_e", "row_noise_e", "dark_current_e_per_s", "dark_current_doubling_k", "tap_gain_mismatch",
                 "tap_offset_mismatch_e", "crosstalk_left_right", "crosstalk_up_down", "nonlinearity", "prnu", "dsnu_dn", "delay_s",
                 "phase_offset_rad", "pattern_seed", "suppression_threshold_e", "suppression_budget_e", "suppression_noise_factor",
                 "reset_noise_e", "cancels_reset_noise", "blooming_share", "blooming_limit_e")
    quantum_efficiency: Curve
    contrast: Curve
    contrast_by_wavelength: Curve
    bandwidth_hz: float
    full_well_e: float
    read_noise_e: float
    column_noise_e: float
    row_noise_e: float
    dark_current_e_per_s: float
    dark_current_doubling_k: float
    tap_gain_mismatch: float
    tap_offset_mismatch_e: float
    crosstalk_left_right: float
    crosstalk_up_down: float
    nonlinearity: Curve
    prnu: float
    dsnu_dn: float
    delay_s: float
    phase_offset_rad: float
    pattern_seed: int
    suppression_threshold_e: float
    suppression_budget_e: float
    suppression_noise_factor: float
    reset_noise_e: float
    cancels_reset_noise: bool
    blooming_share: float
    blooming_limit_e: float

    def __init__(
        self,
        *,
        quantum_efficiency: Curve | None = None,
        contrast: Curve | None = None,
        contrast_by_wavelength: Curve | None = None,
        bandwidth_hz: float = 0.0,
        full_well_e: float = 1e+30,
        read_noise_e: float = 0.0,
        column_noise_e: float = 0.0,
        row_noise_e: float = 0.0,
        dark_current_e_per_s: float = 0.0,
        dark_current_doubling_k: float = 0.0,
        tap_gain_mismatch: float = 0.0,
        tap_offset_mismatch_e: float = 0.0,
        crosstalk_left_right: float = 0.0,
        crosstalk_up_down: float = 0.0,
        nonlinearity: Curve | None = None,
        prnu: float = 0.0,
        dsnu_dn: float = 0.0,
        delay_s: float = 0.0,
        phase_offset_rad: float = 0.0,
        pattern_seed: int = 1,
        suppression_threshold_e: float = 0.0,
        suppression_budget_e: float = 0.0,
        suppression_noise_factor: float = 1.0,
        reset_noise_e: float = 0.0,
        cancels_reset_noise: bool = False,
        blooming_share: float = 0.0,
        blooming_limit_e: float = 0.0,
    ) -> None:
        self.quantum_efficiency = Curve() if quantum_efficiency is None else quantum_efficiency
        self.contrast = Curve() if contrast is None else contrast
        self.contrast_by_wavelength = Curve() if contrast_by_wavelength is None else contrast_by_wavelength
        self.bandwidth_hz = bandwidth_hz
        self.full_well_e = full_well_e
        self.read_noise_e = read_noise_e
        self.column_noise_e = column_noise_e
        self.row_noise_e = row_noise_e
        self.dark_current_e_per_s = dark_current_e_per_s
        self.dark_current_doubling_k = dark_current_doubling_k
        self.tap_gain_mismatch = tap_gain_mismatch
        self.tap_offset_mismatch_e = tap_offset_mismatch_e
        self.crosstalk_left_right = crosstalk_left_right
        self.crosstalk_up_down = crosstalk_up_down
        self.nonlinearity = Curve() if nonlinearity is None else nonlinearity
        self.prnu = prnu
        self.dsnu_dn = dsnu_dn
        self.delay_s = delay_s
        self.phase_offset_rad = phase_offset_rad
        self.pattern_seed = pattern_seed
        self.suppression_threshold_e = suppression_threshold_e
        self.suppression_budget_e = suppression_budget_e
        self.suppression_noise_factor = suppression_noise_factor
        self.reset_noise_e = reset_noise_e
        self.cancels_reset_noise = cancels_reset_noise
        self.blooming_share = blooming_share
        self.blooming_limit_e = blooming_limit_e


class Adc(Record):
    """The converter of A−B to codes: code = round((A−B)/step + mid), clipped to its bits
    [theory: adc].

    Attributes
    ----------
    bits : int
        Codes go from 0 to 2^bits - 1. From 1 to 16.
    step_e_per_dn : float, e/DN
        Electrons of A-B per code. From 1e-6 to 1e9.
    mid_code : float, DN
        Code of A-B = 0; in files the middle unless given. 2^(bits − 1) is the middle. From 0 to
        65535.
    valid_min : int
        Lowest valid code; codes below are flagged as saturated; in files 0 unless given. Codes
        outside valid_min…valid_max flag the pixel as saturated. From 0 to 65535.
    valid_max : int
        Highest valid code; codes above are flagged as saturated; in files the largest unless given.
        From 0 to 65535.
    gains : list[float], 1
        Gains that modes may choose from; a mode's step is `step_e_per_dn` over its gain. From 0.01
        to 100.
    """
    __slots__ = ("bits", "step_e_per_dn", "mid_code", "valid_min", "valid_max", "gains")
    bits: int
    step_e_per_dn: float
    mid_code: float
    valid_min: int
    valid_max: int
    gains: list[float]

    def __init__(
        self,
        *,
        bits: int = 12,
        step_e_per_dn: float = 1.0,
        mid_code: float = 2048.0,
        valid_min: int = 0,
        valid_max: int = 4095,
        gains: Sequence[float] = (),
    ) -> None:
        self.bits = bits
        self.step_e_per_dn = step_e_per_dn
        self.mid_code = mid_code
        self.valid_min = valid_min
        self.valid_max = valid_max
        self.gains = list(gains)


class ImageFilter(Record):
    """Image filter over the range image; invalid pixels are neither changed nor used. Bilateral and
    adaptive filters leave edges as they are, and come before the check for flying pixels; the
    others come after it.

    Attributes
    ----------
    kind : Literal["none", "gaussian", "median", "bilateral", "adaptive"]
    sigma_px : float, px
        gaussian, bilateral: standard deviation of the kernel. From 0.1 to 10.
    radius_px : int
        median, adaptive: radius of the window of (2 radius + 1)^2 pixels; adaptive: of the largest
        one. From 1 to 4.
    sigmas : float, 1
        bilateral, adaptive: neighbours count if they differ by less than this times the noise. From
        0 to 1000.
    range_m : float, m
        bilateral: length added in quadrature to the limit that sigmas sets. From 0 to 1000.
    goal_m : float, m
        adaptive: target noise: neighbours are added until it is reached. From 0 to 1000.
    """
    __slots__ = ("kind", "sigma_px", "radius_px", "sigmas", "range_m", "goal_m")
    kind: Literal["none", "gaussian", "median", "bilateral", "adaptive"]
    sigma_px: float
    radius_px: int
    sigmas: float
    range_m: float
    goal_m: float

    def __init__(
        self,
        *,
        kind: Literal["none", "gaussian", "median", "bilateral", "adaptive"] = 'none',
        sigma_px: float = 1.0,
        radius_px: int = 1,
        sigmas: float = 3.0,
        range_m: float = 0.0,
        goal_m: float = 0.01,
    ) -> None:
        self.kind = kind
        self.sigma_px = sigma_px
        self.radius_px = radius_px
        self.sigmas = sigmas
        self.range_m = range_m
        self.goal_m = goal_m


class FrequencyCalibration(Record):
    """What a decoder knows of one modulation frequency of a specimen: by how much phases are measured
    too large (theory 4.13).

    Attributes
    ----------
    modulation_frequency_hz : float, Hz
        Modulation frequency that this entry is for. From 1000 to 1e10.
    phase_offset_rad : float, rad
        Amount by which measured phases are too large, in all pixels. From -100 to 100.
    drift_m_per_kelvin : float, m/K
        Drift of the range per kelvin of temperature.actual above the calibration's reference. From
        -1 to 1.
    wiggling_cos_rad : list[float], rad
        Phase error by harmonics, as cosines and sines of 1, 2, ... times the measured phase:
        amplitude of each cosine, from the first order on. From -1 to 1.
    wiggling_sin_rad : list[float], rad
        Phase error by harmonics, as cosines and sines of 1, 2, ... times the measured phase:
        amplitude of each sine, as many as cosines. From -1 to 1.
    pixel_phase_file : str
        A .npy file beside this one or below: additional phase [rad] of each pixel, [height, width];
        in files 0 unless given. Name of the file of pixel_phase_rad: `meta` has the name alone.
    pixel_phase_rad : list[float], rad
        Additional phase of each pixel, [height][width] of the image that is read out; none: 0.
    """
    __slots__ = ("modulation_frequency_hz", "phase_offset_rad", "drift_m_per_kelvin", "wiggling_cos_rad", "wiggling_sin_rad",
                 "pixel_phase_file", "pixel_phase_rad")
    modulation_frequency_hz: float
    phase_offset_rad: float
    drift_m_per_kelvin: float
    wiggling_cos_rad: list[float]
    wiggling_sin_rad: list[float]
    pixel_phase_file: str
    pixel_phase_rad: list[float]

    def __init__(
        self,
        *,
        modulation_frequency_hz: float = 0.0,
        phase_offset_rad: float = 0.0,
        drift_m_per_kelvin: float = 0.0,
        wiggling_cos_rad: Sequence[float] = (),
        wiggling_sin_rad: Sequence[float] = (),
        pixel_phase_file: str = '',
        pixel_phase_rad: Sequence[float] = (),
    ) -> None:
        self.modulation_frequency_hz = modulation_frequency_hz
        self.phase_offset_rad = phase_offset_rad
        self.drift_m_per_kelvin = drift_m_per_kelvin
        self.wiggling_cos_rad = list(wiggling_cos_rad)
        self.wiggling_sin_rad = list(wiggling_sin_rad)
        self.pixel_phase_file = pixel_phase_file
        self.pixel_phase_rad = list(pixel_phase_rad)


class DecoderCalibration(Record):
    """What decoding knows of the specimen that took the raw frames. (Camera::calibration is what raw
    data are off by, and is always known.).

    Attributes
    ----------
    kind : Literal["exact", "none", "specimen"]
        exact: all that the profile says, each pixel's own phase included; none: a sine, and equal
        pixels; specimen: the members below.
    reference_celsius : float, degC
        specimen: temperature at which the specimen was measured. From -100 to 200.
    frequencies : list[FrequencyCalibration]
        specimen: one entry for each modulation frequency of the mode.
    """
    __slots__ = ("kind", "reference_celsius", "frequencies")
    kind: Literal["exact", "none", "specimen"]
    reference_celsius: float
    frequencies: list[FrequencyCalibration]

    def __init__(
        self,
        *,
        kind: Literal["exact", "none", "specimen"] = 'exact',
        reference_celsius: float = 25.0,
        frequencies: Sequence[FrequencyCalibration] = (),
    ) -> None:
        self.kind = kind
        self.reference_celsius = reference_celsius
        self.frequencies = list(frequencies)


class Decoding(Record):
    """How raw frames become depth (theory 4).

    Attributes
    ----------
    wiggling_correction : bool
        Correct the phase error by harmonics (wiggling).
    noise_threshold_m : float, m
        Noise above which a pixel is flagged as low signal; also the scale of confidence. From 1e-6
        to 1000.
    amplitude_threshold_e : float, e
        Amplitude below which a pixel is flagged as low signal. From 0 to 1e12.
    lower_saturation_dn : float | None, DN
        Lowest code that is not flagged as saturated; adc.valid_min unless given. From 0 to 65535.
    upper_saturation_dn : float | None, DN
        Highest code that is not flagged as saturated; adc.valid_max unless given. From 0 to 65535.
    flying_near_z_m : float, m
        Limits of the flying pixel flag: z from which on the limit on |dz| grows linearly. From 0 to
        10000.
    flying_near_limit_m : float, m
        Limits of the flying pixel flag: limit on |dz| up to flying_near_z_m. From 0 to 1000.
    flying_far_z_m : float, m
        Limits of the flying pixel flag: z up to which the limit on |dz| grows. From 0 to 10000.
    flying_far_limit_m : float, m
        Limits of the flying pixel flag: limit on |dz| from flying_far_z_m on. From 0 to 1000.
    flying_sigmas : float, 1
        Limits of the flying pixel flag: |dz| must also exceed this times its noise; 0: the limit
        alone. From 0 to 1000.
    flying_check : bool
        Limits of the flying pixel flag: whether flying pixels are detected.
    asymmetry_limit_e : float, e
        Check of raw frames half a period apart, whose sum is 0 unless something moves: largest |D_k
        + D_k+2| before a pixel is flagged. From 0 to 1e12.
    asymmetry_sigmas : float, 1
        Check of raw frames half a period apart, whose sum is 0 unless something moves: the sum must
        also exceed this times its noise. From 0 to 1000.
    asymmetry_reject : bool
        Check of raw frames half a period apart, whose sum is 0 unless something moves: whether the
        depth of a flagged pixel is invalid.
    multipath_limit_m : float, m
        Check of two modulation frequencies, whose ranges agree unless light took several paths:
        largest difference of the ranges before a pixel is flagged. From 0 to 10000.
    multipath_sigmas : float, 1
        Check of two modulation frequencies, whose ranges agree unless light took several paths: the
        difference must also exceed this times its noise. From 0 to 1000.
    multipath_reject : bool
        Check of two modulation frequencies, whose ranges agree unless light took several paths:
        whether the depth of a flagged pixel is invalid.
    temporal_frames : int
        Mean over frames that follow each other, pixel by pixel: number of frames in the mean, the
        current one and those before it; 1: no mean. From 1 to 32.
    temporal_sigmas : float, 1
        Mean over frames that follow each other, pixel by pixel: frames count if they differ by less
        than this times the noise. From 0 to 1000.
    filter : ImageFilter
        Filter over the range image.
    calibration : DecoderCalibration
        What decoding knows of the specimen: exact (everything), none (a sine, equal pixels), or a
        calibration file.
    """
    __slots__ = ("wiggling_correction", "noise_threshold_m", "amplitude_threshold_e", "lower_saturation_dn", "upper_saturation_dn",
                 "flying_near_z_m", "flying_near_limit_m", "flying_far_z_m", "flying_far_limit_m", "flying_sigmas", "flying_check",
                 "asymmetry_limit_e", "asymmetry_sigmas", "asymmetry_reject", "multipath_limit_m", "multipath_sigmas",
                 "multipath_reject", "temporal_frames", "temporal_sigmas", "filter", "calibration")
    wiggling_correction: bool
    noise_threshold_m: float
    amplitude_threshold_e: float
    lower_saturation_dn: float | None
    upper_saturation_dn: float | None
    flying_near_z_m: float
    flying_near_limit_m: float
    flying_far_z_m: float
    flying_far_limit_m: float
    flying_sigmas: float
    flying_check: bool
    asymmetry_limit_e: float
    asymmetry_sigmas: float
    asymmetry_reject: bool
    multipath_limit_m: float
    multipath_sigmas: float
    multipath_reject: bool
    temporal_frames: int
    temporal_sigmas: float
    filter: ImageFilter
    calibration: DecoderCalibration

    def __init__(
        self,
        *,
        wiggling_correction: bool = True,
        noise_threshold_m: float = 0.07,
        amplitude_threshold_e: float = 0.0,
        lower_saturation_dn: float | None = None,
        upper_saturation_dn: float | None = None,
        flying_near_z_m: float = 1.0,
        flying_near_limit_m: float = 0.018,
        flying_far_z_m: float = 4.5,
        flying_far_limit_m: float = 0.14,
        flying_sigmas: float = 4.0,
        flying_check: bool = True,
        asymmetry_limit_e: float = 0.0,
        asymmetry_sigmas: float = 5.0,
        asymmetry_reject: bool = False,
        multipath_limit_m: float = 0.1,
        multipath_sigmas: float = 3.0,
        multipath_reject: bool = False,
        temporal_frames: int = 1,
        temporal_sigmas: float = 3.0,
        filter: ImageFilter | None = None,
        calibration: DecoderCalibration | None = None,
    ) -> None:
        self.wiggling_correction = wiggling_correction
        self.noise_threshold_m = noise_threshold_m
        self.amplitude_threshold_e = amplitude_threshold_e
        self.lower_saturation_dn = lower_saturation_dn
        self.upper_saturation_dn = upper_saturation_dn
        self.flying_near_z_m = flying_near_z_m
        self.flying_near_limit_m = flying_near_limit_m
        self.flying_far_z_m = flying_far_z_m
        self.flying_far_limit_m = flying_far_limit_m
        self.flying_sigmas = flying_sigmas
        self.flying_check = flying_check
        self.asymmetry_limit_e = asymmetry_limit_e
        self.asymmetry_sigmas = asymmetry_sigmas
        self.asymmetry_reject = asymmetry_reject
        self.multipath_limit_m = multipath_limit_m
        self.multipath_sigmas = multipath_sigmas
        self.multipath_reject = multipath_reject
        self.temporal_frames = temporal_frames
        self.temporal_sigmas = temporal_sigmas
        self.filter = ImageFilter() if filter is None else filter
        self.calibration = DecoderCalibration() if calibration is None else calibration


class Temperature(Record):
    """How much of the distance is drift with temperature, and with the time since the camera was
    switched on.

    Attributes
    ----------
    celsius : float, degC
        Temperature of the camera. From -100 to 200.
    reference_celsius : float, degC
        Temperature at which the range has no drift. From -100 to 200.
    drift_m_per_kelvin : float, m/K
        Drift of the range per kelvin above the reference. From -1 to 1.
    warm_up_m : float, m
        Drift of the range while the camera warms up, first order. From -1 to 1.
    warm_up_time_s : float, s
        Time constant of the warm-up. From 0.001 to 1e6.
    since_start_s : float, s
        Time since the camera was switched on, at frame 0. From 0 to 1e12.
    """
    __slots__ = ("celsius", "reference_celsius", "drift_m_per_kelvin", "warm_up_m", "warm_up_time_s", "since_start_s")
    celsius: float
    reference_celsius: float
    drift_m_per_kelvin: float
    warm_up_m: float
    warm_up_time_s: float
    since_start_s: float

    def __init__(
        self,
        *,
        celsius: float = 25.0,
        reference_celsius: float = 25.0,
        drift_m_per_kelvin: float = 0.0,
        warm_up_m: float = 0.0,
        warm_up_time_s: float = 600.0,
        since_start_s: float = 1000000000.0,
    ) -> None:
        self.celsius = celsius
        self.reference_celsius = reference_celsius
        self.drift_m_per_kelvin = drift_m_per_kelvin
        self.warm_up_m = warm_up_m
        self.warm_up_time_s = warm_up_time_s
        self.since_start_s = since_start_s


class Interference(Record):
    """Another camera of the same kind, at the same place, whose light falls on the same surfaces
    (theory 3.7).

    Attributes
    ----------
    share : float, 1
        Light of the other camera over that of this one, in each pixel; 0: no other camera. From 0
        to 100.
    frequency_difference_hz : float, Hz
        Modulation frequencies of the other camera less those of this one. From -1e9 to 1e9.
    active : float, 1
        Probability that a raw frame overlaps the other camera's exposure. From 0 to 1.
    phase_rad : float | None, rad
        Phase by which the other camera's light lags at the start of frame 0; drawn for each raw
        frame unless given. From -100 to 100.
    """
    __slots__ = ("share", "frequency_difference_hz", "active", "phase_rad")
    share: float
    frequency_difference_hz: float
    active: float
    phase_rad: float | None

    def __init__(
        self,
        *,
        share: float = 0.0,
        frequency_difference_hz: float = 0.0,
        active: float = 1.0,
        phase_rad: float | None = None,
    ) -> None:
        self.share = share
        self.frequency_difference_hz = frequency_difference_hz
        self.active = active
        self.phase_rad = phase_rad


class Calibration(Record):
    """What raw data are off by, the same in all pixels: delays of cables, drivers and gates. Simulated
    raw frames have it, too, and decoding takes it off again (theory 4.10).

    Attributes
    ----------
    range_offset_m : float, m
        Amount by which raw data show surfaces too far; decoding subtracts it. From -10000 to 10000.
    phase_offset : Curve
        Amount by which phases of raw data are too large in addition; decoding subtracts it; in
        files 0 unless given. Modulation frequency [Hz] → how much too large its phase is in raw
        data [rad], besides; one sample: a constant; none: 0. x: modulation frequency from 1000 to
        1e10 Hz, y: value from -100 to 100 rad.
    """
    __slots__ = ("range_offset_m", "phase_offset")
    range_offset_m: float
    phase_offset: Curve

    def __init__(
        self,
        *,
        range_offset_m: float = 0.0,
        phase_offset: Curve | None = None,
    ) -> None:
        self.range_offset_m = range_offset_m
        self.phase_offset = Curve() if phase_offset is None else phase_offset


class SpreadSpectrum(Record):
    """Modulation frequencies that are swept evenly over a band within each exposure, so that they
    disturb radios less (theory 3.9).

    Attributes
    ----------
    width : float, 1
        Width of the band over the modulation frequency; 0: none. From 0 to 0.5.
    kind : Literal["center", "down"]
        center: the modulation frequency is the band's middle; down: its upper end.
    """
    __slots__ = ("width", "kind")
    width: float
    kind: Literal["center", "down"]

    def __init__(
        self,
        *,
        width: float = 0.0,
        kind: Literal["center", "down"] = 'center',
    ) -> None:
        self.width = width
        self.kind = kind


class Readout(Record):
    """Which of the sensor's pixels are read, and how many of them together (theory 4.8).

    Attributes
    ----------
    binning : int
        n: charge of n x n pixels is added before it is read. From 1 to 16.
    left : int
        The rectangle of the sensor that is read, in pixels of the sensor: first column that is
        read. From 0 to 16384.
    top : int
        The rectangle of the sensor that is read, in pixels of the sensor: first row that is read.
        From 0 to 16384.
    width : int
        The rectangle of the sensor that is read, in pixels of the sensor: number of columns; 0: up
        to the sensor's edge. From 0 to 16384.
    height : int
        The rectangle of the sensor that is read, in pixels of the sensor: number of rows; 0: up to
        the sensor's edge. From 0 to 16384.
    """
    __slots__ = ("binning", "left", "top", "width", "height")
    binning: int
    left: int
    top: int
    width: int
    height: int

    def __init__(
        self,
        *,
        binning: int = 1,
        left: int = 0,
        top: int = 0,
        width: int = 0,
        height: int = 0,
    ) -> None:
        self.binning = binning
        self.left = left
        self.top = top
        self.width = width
        self.height = height


class AutoExposure(Record):
    """Integration times that follow the light, from frame to frame (theory 4.9).

    Attributes
    ----------
    speed : float, 1
        Share of the way to the aim that each frame takes; 0: integration times are fixed. From 0 to
        1.
    aim : float, 1
        Share of the valid codes, and of the full well, that bright pixels are to reach. From 0.01
        to 1.
    bright : float, 1
        Quantile of all pixels that counts as bright. From 0 to 1.
    shortest_s : float, s
        Lower limit of the longest lit integration time; 0: timing.min_integration_time. From 0 to
        1000.
    longest_s : float, s
        Upper limit of the longest lit integration time; 0: that of the mode. From 0 to 1000.
    """
    __slots__ = ("speed", "aim", "bright", "shortest_s", "longest_s")
    speed: float
    aim: float
    bright: float
    shortest_s: float
    longest_s: float

    def __init__(
        self,
        *,
        speed: float = 0.0,
        aim: float = 0.7,
        bright: float = 0.99,
        shortest_s: float = 0.0,
        longest_s: float = 0.0,
    ) -> None:
        self.speed = speed
        self.aim = aim
        self.bright = bright
        self.shortest_s = shortest_s
        self.longest_s = longest_s


class RawFrame(Record):
    """One exposure of the sequence.

    Attributes
    ----------
    lit : bool
        Whether the camera's light is on.
    modulation_frequency_hz : float, Hz
        lit: modulation frequency of a lit raw frame. From 1000 to 1e10.
    reference_phase_rad : float, rad
        lit: reference phase of a lit raw frame; a list makes one raw frame of each value. From -100
        to 100.
    integration_time_s : float, s
        Time for which the raw frame collects light. From 1e-9 to 1000.
    reference_delay_s : float, s
        lit: delay of the light, in place of reference_phase_rad. From -0.001 to 0.001.
    """
    __slots__ = ("lit", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "reference_delay_s")
    lit: bool
    modulation_frequency_hz: float
    reference_phase_rad: float
    integration_time_s: float
    reference_delay_s: float

    def __init__(
        self,
        *,
        lit: bool = True,
        modulation_frequency_hz: float = 0.0,
        reference_phase_rad: float = 0.0,
        integration_time_s: float = 0.0,
        reference_delay_s: float = 0.0,
    ) -> None:
        self.lit = lit
        self.modulation_frequency_hz = modulation_frequency_hz
        self.reference_phase_rad = reference_phase_rad
        self.integration_time_s = integration_time_s
        self.reference_delay_s = reference_delay_s


class Mode(Record):
    """One of a profile's modes: the raw frames that make a frame, in their order, and how often a
    frame begins.

    Attributes
    ----------
    name : str
    frame_rate_hz : float, Hz
        Frames per second: frame i starts at i / frame_rate_hz. From 0.0001 to 100000.
    sequence : list[RawFrame]
        The raw frames, in order.
    gain : float, 1
        Gain before the ADC, one of adc.gains. From 0.01 to 100.
    """
    __slots__ = ("name", "frame_rate_hz", "sequence", "gain")
    name: str
    frame_rate_hz: float
    sequence: list[RawFrame]
    gain: float

    def __init__(
        self,
        *,
        name: str = '',
        frame_rate_hz: float = 0.0,
        sequence: Sequence[RawFrame] = (),
        gain: float = 1.0,
    ) -> None:
        self.name = name
        self.frame_rate_hz = frame_rate_hz
        self.sequence = list(sequence)
        self.gain = gain


class Camera(Record):
    """A camera in one of its modes: lens, light sources, pixel, ADC, the sequence of raw frames, and
    how they are decoded.

    Attributes
    ----------
    name : str
        Name of the camera.
    source : str
        The file it came from.
    sensor : Sensor
        The grid of pixels.
    lens : Lens
        The lens: from directions to pixels.
    filter : Filter
        The optical filter before the sensor, for ambient light.
    illumination : list[Illumination]
        The camera's light sources, whose light adds up.
    pixel : Pixel
        The two-tap pixel.
    adc : Adc
        The converter from electrons to codes.
    decoding : Decoding
        From raw frames to depth.
    temperature : Temperature
        Drift of the range.
    interference : Interference
        Light of another camera of the same kind, at the same place.
    calibration : Calibration
        Offsets of raw data, the same in all pixels.
    spread_spectrum : SpreadSpectrum
        Modulation frequencies swept over a band within each exposure.
    readout : Readout
        Which pixels of the sensor are read, and how many together.
    auto_exposure : AutoExposure
        Integration times that follow the light, from frame to frame.
    refractive_index : float, 1
        Refractive index of the medium that light travels in. From 1 to 3.
    readout_time_s : float, s
        Timing of the readout: from the end of one exposure to the start of the next. From 0 to 10.
    min_integration_time_s : float, s
        Timing of the readout: shortest exposure the camera can do. From 0 to 10.
    power_model : Literal["tofray", "paper_literal"]
        paper_literal: the printed formula of the paper, for comparison only.
    mode : Mode
        The chosen one.
    mode_names : list[str]
        All that the profile has.
    """
    __slots__ = ("name", "source", "sensor", "lens", "filter", "illumination", "pixel", "adc", "decoding", "temperature",
                 "interference", "calibration", "spread_spectrum", "readout", "auto_exposure", "refractive_index", "readout_time_s",
                 "min_integration_time_s", "power_model", "mode", "mode_names")
    name: str
    source: str
    sensor: Sensor
    lens: Lens
    filter: Filter
    illumination: list[Illumination]
    pixel: Pixel
    adc: Adc
    decoding: Decoding
    temperature: Temperature
    interference: Interference
    calibration: Calibration
    spread_spectrum: SpreadSpectrum
    readout: Readout
    auto_exposure: AutoExposure
    refractive_index: float
    readout_time_s: float
    min_integration_time_s: float
    power_model: Literal["tofray", "paper_literal"]
    mode: Mode
    mode_names: list[str]

    def __init__(
        self,
        *,
        name: str = '',
        source: str = '',
        sensor: Sensor | None = None,
        lens: Lens | None = None,
        filter: Filter | None = None,
        illumination: Sequence[Illumination] = (),
        pixel: Pixel | None = None,
        adc: Adc | None = None,
        decoding: Decoding | None = None,
        temperature: Temperature | None = None,
        interference: Interference | None = None,
        calibration: Calibration | None = None,
        spread_spectrum: SpreadSpectrum | None = None,
        readout: Readout | None = None,
        auto_exposure: AutoExposure | None = None,
        refractive_index: float = 1.0,
        readout_time_s: float = 0.0,
        min_integration_time_s: float = 0.0,
        power_model: Literal["tofray", "paper_literal"] = 'tofray',
        mode: Mode | None = None,
        mode_names: Sequence[str] = (),
    ) -> None:
        self.name = name
        self.source = source
        self.sensor = Sensor() if sensor is None else sensor
        self.lens = Lens() if lens is None else lens
        self.filter = Filter() if filter is None else filter
        self.illumination = list(illumination)
        self.pixel = Pixel() if pixel is None else pixel
        self.adc = Adc() if adc is None else adc
        self.decoding = Decoding() if decoding is None else decoding
        self.temperature = Temperature() if temperature is None else temperature
        self.interference = Interference() if interference is None else interference
        self.calibration = Calibration() if calibration is None else calibration
        self.spread_spectrum = SpreadSpectrum() if spread_spectrum is None else spread_spectrum
        self.readout = Readout() if readout is None else readout
        self.auto_exposure = AutoExposure() if auto_exposure is None else auto_exposure
        self.refractive_index = refractive_index
        self.readout_time_s = readout_time_s
        self.min_integration_time_s = min_integration_time_s
        self.power_model = power_model
        self.mode = Mode() if mode is None else mode
        self.mode_names = list(mode_names)


class Pose(PoseMethods):
    """Where the camera stands. Camera frame: x right, y down, z forward (the optical frame of ROS and
    OpenCV).

    Attributes
    ----------
    position : tuple[float, float, float], m
        Position of the entrance pupil. From -100000 to 100000.
    look_at : tuple[float, float, float], m
        A point on the optical axis; [1, 0, 0] where `world_up` is z. From -100000 to 100000.
    up : tuple[float, float, float], 1
        World direction that is up in the image; that of `world_up` unless given. From -1e6 to 1e6.
    quaternion : tuple[float, float, float, float] | None, 1
        Unit quaternion x, y, z, w from the camera's frame to the world's. From -1e6 to 1e6.
    """
    __slots__ = ("position", "look_at", "up", "quaternion")
    position: tuple[float, float, float]
    look_at: tuple[float, float, float]
    up: tuple[float, float, float]
    quaternion: tuple[float, float, float, float] | None

    def __init__(
        self,
        *,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        look_at: tuple[float, float, float] = (0.0, 0.0, 1.0),
        up: tuple[float, float, float] = (0.0, -1.0, 0.0),
        quaternion: tuple[float, float, float, float] | None = None,
    ) -> None:
        self.position = position
        self.look_at = look_at
        self.up = up
        self.quaternion = quaternion


class CameraKeyframe(Record):
    """Where the camera stands at a time. Between two of them its position changes evenly. Where one
    has a quaternion it turns evenly, the shortest way; else look_at and up change evenly: a camera
    that looks at one point goes on doing so. Before the first and after the last it stands still.

    Attributes
    ----------
    time_s : float, s
        Time of the keyframe; frame i starts at i / frame rate. From -1e6 to 1e6.
    pose : Pose
        Pose of the camera at that time.
    """
    __slots__ = ("time_s", "pose")
    time_s: float
    pose: Pose

    def __init__(
        self,
        *,
        time_s: float = 0.0,
        pose: Pose | None = None,
    ) -> None:
        self.time_s = time_s
        self.pose = Pose() if pose is None else pose


class Override(Record):
    """A key of the profile that the scene changes: dotted path and the text of the value, e.g.
    {"lens.f_number", "1.2"} or {"integration_time", "500 us"}.

    Attributes
    ----------
    key : str
    value : str
    where : str
        file:line:col for messages; empty if built in code.
    """
    __slots__ = ("key", "value", "where")
    key: str
    value: str
    where: str

    def __init__(
        self,
        *,
        key: str = '',
        value: str = '',
        where: str = '',
    ) -> None:
        self.key = key
        self.value = value
        self.where = where


class CameraChoice(Record):
    """The scene's `camera` section: which profile and mode to take, and what to change in it.

    Attributes
    ----------
    profile : str
        A built-in camera (`tofray list cameras`), or a profile's file beside the scene or below.
    mode : str
        One of the profile's modes; in files its first unless given. empty: the profile's first.
    pose : Pose
        Pose of the camera; the world's frame is the camera's unless given.
    keyframes : list[CameraKeyframe]
        Poses of the camera at times, in place of `pose`; motion between two is even.
    overrides : list[Override]
    profile_where : str
        file:line:col for messages; empty if built in code.
    mode_where : str
        file:line:col for messages; empty if built in code.
    """
    __slots__ = ("profile", "mode", "pose", "keyframes", "overrides", "profile_where", "mode_where")
    profile: str
    mode: str
    pose: Pose
    keyframes: list[CameraKeyframe]
    overrides: list[Override]
    profile_where: str
    mode_where: str

    def __init__(
        self,
        *,
        profile: str = 'pico-flexx',
        mode: str = '',
        pose: Pose | None = None,
        keyframes: Sequence[CameraKeyframe] = (),
        overrides: Sequence[Override] = (),
        profile_where: str = '',
        mode_where: str = '',
    ) -> None:
        self.profile = profile
        self.mode = mode
        self.pose = Pose() if pose is None else pose
        self.keyframes = list(keyframes)
        self.overrides = list(overrides)
        self.profile_where = profile_where
        self.mode_where = mode_where


class Ambient(Record):
    """Ambient light: all but the camera's illumination. One of level, illuminance and band irradiance
    says how much.

    Attributes
    ----------
    spectrum : Literal["none", "sun_am15", "equal_energy", "table"]
        Spectrum of the light: a built-in name, or a table; in files sun_am15 unless given.
    quantity : Literal["level", "illuminance_lx", "band_irradiance_w_per_m2"]
    amount : float, 1 or lx or W/m2
        level: share of the tabulated spectrum (sun_am15: of full sun). From 0 to 100.
        illuminance_lx: illuminance of the surfaces, as a light meter reads it. From 0 to 1e7.
        band_irradiance_w_per_m2: irradiance of the surfaces within the camera's filter. From 0 to
        100000.
    table_wavelength_m : list[float], m
        table: spectral irradiance on the surfaces. From 1e-7 to 2e-5.
    table_irradiance_w_per_m3 : list[float], W/m3
        table: spectral irradiance on the surfaces. From 0 to 1e13.
    direction : tuple[float, float, float] | None, 1
        Direction in which the light travels (a sun with shadows); uniform from everywhere unless
        given. From -1e6 to 1e6.
    """
    __slots__ = ("spectrum", "quantity", "amount", "table_wavelength_m", "table_irradiance_w_per_m3", "direction")
    spectrum: Literal["none", "sun_am15", "equal_energy", "table"]
    quantity: Literal["level", "illuminance_lx", "band_irradiance_w_per_m2"]
    amount: float
    table_wavelength_m: list[float]
    table_irradiance_w_per_m3: list[float]
    direction: tuple[float, float, float] | None

    def __init__(
        self,
        *,
        spectrum: Literal["none", "sun_am15", "equal_energy", "table"] = 'none',
        quantity: Literal["level", "illuminance_lx", "band_irradiance_w_per_m2"] = 'level',
        amount: float = 0.0,
        table_wavelength_m: Sequence[float] = (),
        table_irradiance_w_per_m3: Sequence[float] = (),
        direction: tuple[float, float, float] | None = None,
    ) -> None:
        self.spectrum = spectrum
        self.quantity = quantity
        self.amount = amount
        self.table_wavelength_m = list(table_wavelength_m)
        self.table_irradiance_w_per_m3 = list(table_irradiance_w_per_m3)
        self.direction = direction


class TransientBins(Record):
    """Light by the length of its path, as histograms (Truth::transient_e_per_s): bin k is centred at
    first + (k + ½)·width. Light of a path is shared between the two bins whose centres are nearest.

    Attributes
    ----------
    bins : int
        Number of bins; 0: no histograms. From 0 to 1e6.
    first_m : float, m
        Path length at which the first bin begins, all the way from light to camera. From 0 to 1e6.
    width_m : float, m
        Width of a bin in path length. From 1e-6 to 1e6.
    """
    __slots__ = ("bins", "first_m", "width_m")
    bins: int
    first_m: float
    width_m: float

    def __init__(
        self,
        *,
        bins: int = 0,
        first_m: float = 0.0,
        width_m: float = 0.001,
    ) -> None:
        self.bins = bins
        self.first_m = first_m
        self.width_m = width_m


class Transport(Record):
    """Multipath: light that meets 1, 2 … 1 + bounces surfaces before it reaches the camera. Light
    paths are Monte Carlo samples, the same for all frames: their error is no noise of the camera.
    Arrays in place of the scene bounce nothing.

    Attributes
    ----------
    bounces : int
        Maximum number of bounces: surfaces that light meets beyond the first one. From 0 to 64.
    samples : int
        Light paths per pixel (Monte Carlo samples), where bounces is not 0; the first ones of
        max_samples. From 1 to 65536.
    seed : int
        Seed of the light paths: another one draws other paths of the same light. From 0 to
        9007199254740991.
    max_samples : int
        Most light paths per pixel: their number is doubled, pixel by pixel, until path_noise_m is
        reached; 0: samples. From 0 to 65536.
    path_noise_m : float, m
        Standard error of the half path at which a pixel has enough paths; 0: a fifth of its depth
        noise. From 0 to 100.
    smooth : bool
        Whether light that bounces is smoothed over neighbours that see the same surface.
    transient : TransientBins
        Histograms of light by path length for each pixel; none unless given.
    """
    __slots__ = ("bounces", "samples", "seed", "max_samples", "path_noise_m", "smooth", "transient")
    bounces: int
    samples: int
    seed: int
    max_samples: int
    path_noise_m: float
    smooth: bool
    transient: TransientBins

    def __init__(
        self,
        *,
        bounces: int = 0,
        samples: int = 16,
        seed: int = 0,
        max_samples: int = 0,
        path_noise_m: float = 0.0,
        smooth: bool = False,
        transient: TransientBins | None = None,
    ) -> None:
        self.bounces = bounces
        self.samples = samples
        self.seed = seed
        self.max_samples = max_samples
        self.path_noise_m = path_noise_m
        self.smooth = smooth
        self.transient = TransientBins() if transient is None else transient


class Material(Record):
    """How a surface sends light back, at the illumination wavelength.

    Attributes
    ----------
    name : str
        Empty for a material written inside an object.
    brdf : Literal["lambert", "phong", "oren_nayar", "ggx", "retro"]
    diffuse : float, 1
        lambert, oren_nayar: reflectivity: share of the light that is reflected, all of it
        diffusely. phong: k_d, the Lambertian share. ggx: k_d, the diffuse share below the
        microfacets; 0: a metal. retro: k_d, the Lambertian share. From 0 to 1.
    specular : float, 1
        phong: k_s, the share of the lobe about the mirror direction; diffuse + specular may not
        exceed 1. ggx: F_0, reflectance of a microfacet at normal incidence: 0.04 for plastic, 0.9
        for aluminium. From 0 to 1.
    exponent : float, 1
        phong: exponent n of the lobe's cos^n: the larger, the shinier. From 1 to 10000.
    roughness_rad : float, rad
        oren_nayar: spread (1 sigma) of the slopes of the surface's facets; 0: Lambert. From 0 to
        1.5708.
    alpha : float, 1
        ggx: spread of the microfacets' slopes: glTF's roughness squared. From 0.001 to 1.
    retro : float, 1
        retro: k_r, the share that goes back toward the light; diffuse + retro may not exceed 1.
        From 0 to 1.
    spread_rad : float, rad
        retro: angle between light and camera at which half of the peak is left. From 0.001 to
        0.785398.
    map : ReflectivityMap | None
        Scales `diffuse` from place to place; none: it is the same everywhere.
    normals : VectorMap | None
        How a mesh's normal leans from place to place: its parts along growing u, against growing v,
        and along the normal that the mesh has, −1…1, the last one above 0, of length 0.5…1.5. None:
        it does not.
    finish : VectorMap | None
        GGX, of a mesh: k_d, F_0 and α from place to place, in place of `diffuse`, `specular` and
        `alpha`, which then are a mean for callers; `map` scales k_d, too. None: they are the same
        everywhere.
    opacity : ReflectivityMap | None
        Where a mesh has a surface at all: where this is ½ or more, between texels bilinear; light
        and camera look through the rest. Texels of the other pictures that lie where it is less
        count in no mean. None: everywhere.
    """
    __slots__ = ("name", "brdf", "diffuse", "specular", "exponent", "roughness_rad", "alpha", "retro", "spread_rad", "map", "normals",
                 "finish", "opacity")
    name: str
    brdf: Literal["lambert", "phong", "oren_nayar", "ggx", "retro"]
    diffuse: float
    specular: float
    exponent: float
    roughness_rad: float
    alpha: float
    retro: float
    spread_rad: float
    map: ReflectivityMap | None
    normals: VectorMap | None
    finish: VectorMap | None
    opacity: ReflectivityMap | None

    def __init__(
        self,
        *,
        name: str = '',
        brdf: Literal["lambert", "phong", "oren_nayar", "ggx", "retro"] = 'lambert',
        diffuse: float = 0.0,
        specular: float = 0.0,
        exponent: float = 1.0,
        roughness_rad: float = 0.0,
        alpha: float = 0.5,
        retro: float = 0.0,
        spread_rad: float = 0.01,
        map: ReflectivityMap | None = None,
        normals: VectorMap | None = None,
        finish: VectorMap | None = None,
        opacity: ReflectivityMap | None = None,
    ) -> None:
        self.name = name
        self.brdf = brdf
        self.diffuse = diffuse
        self.specular = specular
        self.exponent = exponent
        self.roughness_rad = roughness_rad
        self.alpha = alpha
        self.retro = retro
        self.spread_rad = spread_rad
        self.map = map
        self.normals = normals
        self.finish = finish
        self.opacity = opacity


class Plane(Record):
    """Infinite; the normal need not be of unit length.

    Attributes
    ----------
    point : tuple[float, float, float], m
        A point of the plane. From -100000 to 100000.
    normal : tuple[float, float, float], 1
        Normal, of any length but zero; both sides reflect. From -1e6 to 1e6.
    """
    __slots__ = ("point", "normal")
    point: tuple[float, float, float]
    normal: tuple[float, float, float]

    def __init__(
        self,
        *,
        point: tuple[float, float, float] = (0.0, 0.0, 0.0),
        normal: tuple[float, float, float] = (0.0, 0.0, -1.0),
    ) -> None:
        self.point = point
        self.normal = normal


class Sphere(Record):
    """A ball's surface.

    Attributes
    ----------
    center : tuple[float, float, float], m
        Centre. From -100000 to 100000.
    radius : float, m
        Radius. From 1e-6 to 100000.
    """
    __slots__ = ("center", "radius")
    center: tuple[float, float, float]
    radius: float

    def __init__(
        self,
        *,
        center: tuple[float, float, float] = (0.0, 0.0, 0.0),
        radius: float = 1.0,
    ) -> None:
        self.center = center
        self.radius = radius


class Box(Record):
    """Along the axes before its rotation.

    Attributes
    ----------
    min : tuple[float, float, float], m
        Corner with the smallest x, y and z, before the rotation. From -100000 to 100000.
    max : tuple[float, float, float], m
        Opposite corner, before the rotation. From -100000 to 100000.
    """
    __slots__ = ("min", "max")
    min: tuple[float, float, float]
    max: tuple[float, float, float]

    def __init__(
        self,
        *,
        min: tuple[float, float, float] = (0.0, 0.0, 0.0),
        max: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        self.min = min
        self.max = max


class Triangle(Record):
    """Flat, between its corners; both sides reflect.

    Attributes
    ----------
    vertices : tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]], m
        Three corners. From -100000 to 100000.
    """
    __slots__ = ("vertices",)
    vertices: tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]

    def __init__(
        self,
        *,
        vertices: tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
        = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    ) -> None:
        self.vertices = vertices


class Cylinder(Record):
    """With caps; the axis need not be of unit length.

    Attributes
    ----------
    center : tuple[float, float, float], m
        Centre, halfway between the caps. From -100000 to 100000.
    axis : tuple[float, float, float], 1
        Axis from cap to cap, of any length but zero. From -1e6 to 1e6.
    radius : float, m
        Radius. From 1e-6 to 100000.
    height : float, m
        Height, from cap to cap. From 1e-6 to 100000.
    """
    __slots__ = ("center", "axis", "radius", "height")
    center: tuple[float, float, float]
    axis: tuple[float, float, float]
    radius: float
    height: float

    def __init__(
        self,
        *,
        center: tuple[float, float, float] = (0.0, 0.0, 0.0),
        axis: tuple[float, float, float] = (0.0, 1.0, 0.0),
        radius: float = 1.0,
        height: float = 1.0,
    ) -> None:
        self.center = center
        self.axis = axis
        self.radius = radius
        self.height = height


class Rectangle(Record):
    """Flat, in the x-y plane before its rotation.

    Attributes
    ----------
    center : tuple[float, float, float], m
        Centre. From -100000 to 100000.
    size : tuple[float, float], m
        Width and height, along x and y before the rotation; both sides reflect. From 1e-6 to
        100000.
    """
    __slots__ = ("center", "size")
    center: tuple[float, float, float]
    size: tuple[float, float]

    def __init__(
        self,
        *,
        center: tuple[float, float, float] = (0.0, 0.0, 0.0),
        size: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        self.center = center
        self.size = size


class Disk(Record):
    """Flat; the normal need not be of unit length.

    Attributes
    ----------
    center : tuple[float, float, float], m
        Centre. From -100000 to 100000.
    normal : tuple[float, float, float], 1
        Normal, of any length but zero; both sides reflect. From -1e6 to 1e6.
    radius : float, m
        Radius. From 1e-6 to 100000.
    """
    __slots__ = ("center", "normal", "radius")
    center: tuple[float, float, float]
    normal: tuple[float, float, float]
    radius: float

    def __init__(
        self,
        *,
        center: tuple[float, float, float] = (0.0, 0.0, 0.0),
        normal: tuple[float, float, float] = (0.0, 0.0, -1.0),
        radius: float = 1.0,
    ) -> None:
        self.center = center
        self.normal = normal
        self.radius = radius


class Capsule(Record):
    """All points within `radius` of the line between its two points, which differ.

    Attributes
    ----------
    start : tuple[float, float, float], m
        Centre of one of the round ends. From -100000 to 100000.
    end : tuple[float, float, float], m
        Centre of the other round end, another point than start. From -100000 to 100000.
    radius : float, m
        Radius. From 1e-6 to 100000.
    """
    __slots__ = ("start", "end", "radius")
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float

    def __init__(
        self,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        end: tuple[float, float, float] = (0.0, 1.0, 0.0),
        radius: float = 1.0,
    ) -> None:
        self.start = start
        self.end = end
        self.radius = radius


class Cone(Record):
    """With a base, whose middle is `base`; the axis, which need not be of unit length, goes from there
    to the tip.

    Attributes
    ----------
    base : tuple[float, float, float], m
        Centre of the base. From -100000 to 100000.
    axis : tuple[float, float, float], 1
        Axis from the base to the tip, of any length but zero. From -1e6 to 1e6.
    radius : float, m
        Radius of the base. From 1e-6 to 100000.
    height : float, m
        Height, from base to tip. From 1e-6 to 100000.
    """
    __slots__ = ("base", "axis", "radius", "height")
    base: tuple[float, float, float]
    axis: tuple[float, float, float]
    radius: float
    height: float

    def __init__(
        self,
        *,
        base: tuple[float, float, float] = (0.0, 0.0, 0.0),
        axis: tuple[float, float, float] = (0.0, -1.0, 0.0),
        radius: float = 1.0,
        height: float = 1.0,
    ) -> None:
        self.base = base
        self.axis = axis
        self.radius = radius
        self.height = height


class Mesh(Record):
    """Many triangles, about the zero of their own frame. In files: those of an OBJ, PLY, STL or glTF
    file, turned and scaled when it is read; of a glTF or OBJ file those of one material, unless the
    object has a material of its own.

    Attributes
    ----------
    file : str
        OBJ, PLY, STL or glTF, beside the scene or below; or tofray:bumpy-ball, tofray:wavy-floor.
    scale : float, 1
        Scale from the file's numbers to metres: 0.001 for a file in mm. From 1e-9 to 1e9.
    up : Literal["automatic", "y", "z", "minus_y", "none"]
        The file's axis that is up, turned to `world_up`; automatic: y of an OBJ or glTF, z of a PLY
        or STL file; none: the file's axes are the world's.
    animation : str
        Animation of a glTF file that `time_s` and `play` refer to: its name, its number from 0 on,
        or all at once; the first unless given.
    time_s : float | None, s
        Time of a glTF file's animation; the file's rest pose unless given. From 0 to 1e6.
    play : Literal["still", "once", "loop"]
        Whether a glTF file's animation plays, from `time_s` (or its start) on: once or repeatedly.
    sha256 : str
        SHA-256 of the file's bytes and those of the files that it names, as hexadecimal digits;
        empty if built in code.
    left_out : int
        Triangles of the file with a corner that is no finite number, or beyond 1e5 m.
    guessed : int
        Materials of the file whose visible colour stands for their reflectivity.
    notices : list[str]
        sentences: what else of the file is left out, or mended.
    triangles : TriangleMesh | None
        The triangles, turned and scaled already; objects may share them.
    motion : MeshMotion | None
        Motion of the vertices; none: the mesh keeps its shape.
    """
    __slots__ = ("file", "scale", "up", "animation", "time_s", "play", "sha256", "left_out", "guessed", "notices", "triangles",
                 "motion")
    file: str
    scale: float
    up: Literal["automatic", "y", "z", "minus_y", "none"]
    animation: str
    time_s: float | None
    play: Literal["still", "once", "loop"]
    sha256: str
    left_out: int
    guessed: int
    notices: list[str]
    triangles: TriangleMesh | None
    motion: MeshMotion | None

    def __init__(
        self,
        *,
        file: str = '',
        scale: float = 1.0,
        up: Literal["automatic", "y", "z", "minus_y", "none"] = 'automatic',
        animation: str = '',
        time_s: float | None = None,
        play: Literal["still", "once", "loop"] = 'still',
        sha256: str = '',
        left_out: int = 0,
        guessed: int = 0,
        notices: Sequence[str] = (),
        triangles: TriangleMesh | None = None,
        motion: MeshMotion | None = None,
    ) -> None:
        self.file = file
        self.scale = scale
        self.up = up
        self.animation = animation
        self.time_s = time_s
        self.play = play
        self.sha256 = sha256
        self.left_out = left_out
        self.guessed = guessed
        self.notices = list(notices)
        self.triangles = triangles
        self.motion = motion


class Rotation(Record):
    """A turn by the right-hand rule about `axis` (any length but zero).

    Attributes
    ----------
    axis : tuple[float, float, float], 1
        Axis of the rotation, by the right-hand rule, of any length but zero. From -1e6 to 1e6.
    angle_rad : float, rad
        Angle of the rotation about axis. From -100 to 100.
    quaternion : tuple[float, float, float, float] | None, 1
        Unit quaternion x, y, z, w. From -1e6 to 1e6.
    """
    __slots__ = ("axis", "angle_rad", "quaternion")
    axis: tuple[float, float, float]
    angle_rad: float
    quaternion: tuple[float, float, float, float] | None

    def __init__(
        self,
        *,
        axis: tuple[float, float, float] = (0.0, 0.0, 1.0),
        angle_rad: float = 0.0,
        quaternion: tuple[float, float, float, float] | None = None,
    ) -> None:
        self.axis = axis
        self.angle_rad = angle_rad
        self.quaternion = quaternion


class Keyframe(Record):
    """Where an object is at a time. Between two of them its shift changes evenly, and it turns evenly:
    where both rotations are about the same axis from the one angle to the other, however far that
    is, else the shortest way. Before the first and after the last it stands still.

    Attributes
    ----------
    time_s : float, s
        Time of the keyframe; frame i starts at i / frame rate. From -1e6 to 1e6.
    position : tuple[float, float, float], m
        Shift of the object. From -100000 to 100000.
    rotation : Rotation
        Rotation about the object's own centre.
    """
    __slots__ = ("time_s", "position", "rotation")
    time_s: float
    position: tuple[float, float, float]
    rotation: Rotation

    def __init__(
        self,
        *,
        time_s: float = 0.0,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        rotation: Rotation | None = None,
    ) -> None:
        self.time_s = time_s
        self.position = position
        self.rotation = Rotation() if rotation is None else rotation


class Object(Record):
    """One thing in the scene. Order of operations: rotation about its own centre (sphere, box,
    cylinder, rectangle, disk: the centre; triangle: the centroid; capsule: halfway between its
    points; plane: its point; cone: the middle of its base; mesh: its zero), then the shift
    `position`; then, both with time, a turn about the centre and a shift: by angular velocity · t
    and velocity · t.

    Attributes
    ----------
    name : str
        Name of the object in listings.
    shape : Plane | Sphere | Box | Triangle | Cylinder | Rectangle | Disk | Capsule | Cone | Mesh
    material : int
        Index in Scene::materials. From 0 to 40000.
    position : tuple[float, float, float], m
        Shift of the object. From -100000 to 100000.
    rotation : Rotation
        Rotation about the object's own centre (of a plane: about its point).
    velocity_m_per_s : tuple[float, float, float], m/s
        Velocity of the object. From -10000 to 10000.
    angular_velocity_rad_per_s : tuple[float, float, float], rad/s
        Angular velocity about the object's own centre: axis times rate. From -10000 to 10000.
    keyframes : list[Keyframe]
        Poses at times, in place of `position`, `rotation` and both velocities; motion between two
        is even.
    class_name : str
        Class of the object, for gt_class_id; see the scene's `classes`.
    key : str
        Address in its file, e.g. "objects.2"; empty if built in code.
    where : str
        file:line:col for messages; empty if built in code.
    """
    __slots__ = ("name", "shape", "material", "position", "rotation", "velocity_m_per_s", "angular_velocity_rad_per_s", "keyframes",
                 "class_name", "key", "where")
    name: str
    shape: Plane | Sphere | Box | Triangle | Cylinder | Rectangle | Disk | Capsule | Cone | Mesh
    material: int
    position: tuple[float, float, float]
    rotation: Rotation
    velocity_m_per_s: tuple[float, float, float]
    angular_velocity_rad_per_s: tuple[float, float, float]
    keyframes: list[Keyframe]
    class_name: str
    key: str
    where: str

    def __init__(
        self,
        *,
        name: str = '',
        shape: Plane | Sphere | Box | Triangle | Cylinder | Rectangle | Disk | Capsule | Cone | Mesh | None = None,
        material: int = 0,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        rotation: Rotation | None = None,
        velocity_m_per_s: tuple[float, float, float] = (0.0, 0.0, 0.0),
        angular_velocity_rad_per_s: tuple[float, float, float] = (0.0, 0.0, 0.0),
        keyframes: Sequence[Keyframe] = (),
        class_name: str = '',
        key: str = '',
        where: str = '',
    ) -> None:
        self.name = name
        self.shape = Plane() if shape is None else shape
        self.material = material
        self.position = position
        self.rotation = Rotation() if rotation is None else rotation
        self.velocity_m_per_s = velocity_m_per_s
        self.angular_velocity_rad_per_s = angular_velocity_rad_per_s
        self.keyframes = list(keyframes)
        self.class_name = class_name
        self.key = key
        self.where = where


class SceneFile(Record):
    """A file that a scene was read from, beside its own and those of meshes.

    Attributes
    ----------
    file : str
        Name in the scene.
    sha256 : str
        SHA-256 of its bytes, as hexadecimal digits.
    """
    __slots__ = ("file", "sha256")
    file: str
    sha256: str

    def __init__(
        self,
        *,
        file: str = '',
        sha256: str = '',
    ) -> None:
        self.file = file
        self.sha256 = sha256


class Scene(Record):
    """All that is seen, in which light, and which camera looks at it.

    Attributes
    ----------
    name : str
        The file's stem, or a built-in name.
    source : str
        The file it came from, empty if built in code.
    camera : CameraChoice
        Which camera, where it stands, and what to change in its profile.
    ambient : Ambient
        Ambient light; none unless given.
    transport : Transport
        multipath: light that bounces from surface to surface; none unless given.
    materials : list[Material]
    objects : list[Object]
    world_up : Literal["minus_y", "y", "z"]
        The world's axis that is up: it decides where a camera looks and what is up in its image
        unless its pose says so, and how meshes are turned; z in the worlds of ROS and Blender.
    files : list[SceneFile]
        Files of keyframes.
    classes : list[str]
        Classes of objects: Truth::class_id counts them. Empty: those that objects have, by the
        order of their letters.
    """
    __slots__ = ("name", "source", "camera", "ambient", "transport", "materials", "objects", "world_up", "files", "classes")
    name: str
    source: str
    camera: CameraChoice
    ambient: Ambient
    transport: Transport
    materials: list[Material]
    objects: list[Object]
    world_up: Literal["minus_y", "y", "z"]
    files: list[SceneFile]
    classes: list[str]

    def __init__(
        self,
        *,
        name: str = '',
        source: str = '',
        camera: CameraChoice | None = None,
        ambient: Ambient | None = None,
        transport: Transport | None = None,
        materials: Sequence[Material] = (),
        objects: Sequence[Object] = (),
        world_up: Literal["minus_y", "y", "z"] = 'minus_y',
        files: Sequence[SceneFile] = (),
        classes: Sequence[str] = (),
    ) -> None:
        self.name = name
        self.source = source
        self.camera = CameraChoice() if camera is None else camera
        self.ambient = Ambient() if ambient is None else ambient
        self.transport = Transport() if transport is None else transport
        self.materials = list(materials)
        self.objects = list(objects)
        self.world_up = world_up
        self.files = list(files)
        self.classes = list(classes)


class RanOn(Record):
    """What frames or depth were computed on.

    Attributes
    ----------
    backend : str
        "cpu" or "cuda".
    device : str
        Its name: of the GPU, or of the processor's instruction set.
    isa : str
        Instruction set of the processor: "scalar", "scalar_fma", "avx2", "avx512" or "neon".
    threads : int
        Threads of the processor.
    block_size : int
        Threads per block of the kernel from ray to depth; 0 where the processor computed.
    occupancy : float, 1
        Share of the GPU that the kernel fills, 0 … 1.
    fallback_reason : str
        Why Backend::automatic took no GPU; empty where it did, or where the processor was asked
        for.
    """
    __slots__ = ("backend", "device", "isa", "threads", "block_size", "occupancy", "fallback_reason")
    backend: str
    device: str
    isa: str
    threads: int
    block_size: int
    occupancy: float
    fallback_reason: str

    def __init__(
        self,
        *,
        backend: str = '',
        device: str = '',
        isa: str = '',
        threads: int = 0,
        block_size: int = 0,
        occupancy: float = 0.0,
        fallback_reason: str = '',
    ) -> None:
        self.backend = backend
        self.device = device
        self.isa = isa
        self.threads = threads
        self.block_size = block_size
        self.occupancy = occupancy
        self.fallback_reason = fallback_reason


class PlanStep(Record):
    """One step of how a frame is computed: a pass over all of its pixels, before the next one begins.

    Attributes
    ----------
    name : str
        Name of the pass: "from_rays", "bounces", "range_filter" ….
    does : str
        What it does, in a few words.
    part : str
        "ground truth", "sample 2 of 9", "paths, step 1": what of it, where it is done in parts.
    over : str
        "tiles", "bands of rows" or "raw frames": what a worker of the processor takes at once.
    pieces : int
        Number of pieces.
    """
    __slots__ = ("name", "does", "part", "over", "pieces")
    name: str
    does: str
    part: str
    over: str
    pieces: int

    def __init__(
        self,
        *,
        name: str = '',
        does: str = '',
        part: str = '',
        over: str = '',
        pieces: int = 0,
    ) -> None:
        self.name = name
        self.does = does
        self.part = part
        self.over = over
        self.pieces = pieces


class Pinhole(PinholeMethods):
    """A camera without distortion, as renderers have it: what is at (x, y, z) before it is seen at
    (fx·x/z + cx, fy·y/z + cy).

    Attributes
    ----------
    width : int
        Size of the picture in pixels; row 0 is the topmost.
    height : int
        Size of the picture in pixels; row 0 is the topmost.
    fx_px : float, px
    fy_px : float, px
    cx_px : float, px
    cy_px : float, px
    pixel_centre : float, px
        Where the middle of the first pixel is: 0.5 where numbers count from the picture's corner,
        as OpenGL, Blender, Open3D and most simulators have it; 0 where they count from that middle,
        as OpenCV, ROS and tofray's lenses do.
    """
    __slots__ = ("width", "height", "fx_px", "fy_px", "cx_px", "cy_px", "pixel_centre")
    width: int
    height: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    pixel_centre: float

    def __init__(
        self,
        *,
        width: int = 0,
        height: int = 0,
        fx_px: float = 0.0,
        fy_px: float = 0.0,
        cx_px: float = 0.0,
        cy_px: float = 0.0,
        pixel_centre: float = 0.5,
    ) -> None:
        self.width = width
        self.height = height
        self.fx_px = fx_px
        self.fy_px = fy_px
        self.cx_px = cx_px
        self.cy_px = cy_px
        self.pixel_centre = pixel_centre


class Placement(PlacementMethods):
    """Where an object is: by how much it is shifted and turned, as its position and rotation say it.

    Attributes
    ----------
    position : tuple[float, float, float], m
        Shift, as Object::position.
    rotation : Rotation
        About the object's own centre, as Object::rotation.
    """
    __slots__ = ("position", "rotation")
    position: tuple[float, float, float]
    rotation: Rotation

    def __init__(
        self,
        *,
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        rotation: Rotation | None = None,
    ) -> None:
        self.position = position
        self.rotation = Rotation() if rotation is None else rotation


class PlacedObject(Record):
    """An object of the scene that is placed from outside, in one frame: in place of its position,
    rotation, velocities and keyframes. What else it does, as a mesh that changes its shape, goes
    on.

    Attributes
    ----------
    name : str
        Object::name, or its place in the scene as listings say it: "objects.2". A mesh whose file
        has several materials is one.
    start : Placement
        Placement at the frame's start.
    end : Placement | None
        Where the next frame starts: it goes there evenly, and on as far again; none: it stands
        still.
    keyframes : list[Keyframe]
        Placements in place of both, by the scene's time, ascending.
    """
    __slots__ = ("name", "start", "end", "keyframes")
    name: str
    start: Placement
    end: Placement | None
    keyframes: list[Keyframe]

    def __init__(
        self,
        *,
        name: str = '',
        start: Placement | None = None,
        end: Placement | None = None,
        keyframes: Sequence[Keyframe] = (),
    ) -> None:
        self.name = name
        self.start = Placement() if start is None else start
        self.end = end
        self.keyframes = list(keyframes)


class FrameRequest(Record):
    """Which frame. What is not set is the simulator's.

    Attributes
    ----------
    index : int
        Chooses the noise; starts at index / frame_rate.
    seed : int | None
    pose : Pose | None
        Pose of the camera at the frame's start.
    pose_end : Pose | None
        Where the next frame starts: it goes there evenly, and on as far again; none: it stands
        still.
    camera : list[CameraKeyframe]
        Poses in place of both poses, by the scene's time, ascending.
    objects : list[PlacedObject]
        Those that are placed from outside; the others move as the scene says.
    start_time_s : float | None, s
        -1e6…1e6: when it starts, in place of index / frame_rate.
    """
    __slots__ = ("index", "seed", "pose", "pose_end", "camera", "objects", "start_time_s")
    index: int
    seed: int | None
    pose: Pose | None
    pose_end: Pose | None
    camera: list[CameraKeyframe]
    objects: list[PlacedObject]
    start_time_s: float | None

    def __init__(
        self,
        *,
        index: int = 0,
        seed: int | None = None,
        pose: Pose | None = None,
        pose_end: Pose | None = None,
        camera: Sequence[CameraKeyframe] = (),
        objects: Sequence[PlacedObject] = (),
        start_time_s: float | None = None,
    ) -> None:
        self.index = index
        self.seed = seed
        self.pose = pose
        self.pose_end = pose_end
        self.camera = list(camera)
        self.objects = list(objects)
        self.start_time_s = start_time_s


class ObjectPlace(Record):
    """Where an object is at one time. Its own frame has the world's axes before it turns, and its zero
    is what it turns about: of a sphere its centre, of a mesh the file's zero. What is at P there is
    at rotation·P + position in the world.

    Attributes
    ----------
    name : str
        Object::name.
    class_name : str
        Object::class_name.
    position : tuple[float, float, float], m
        Position in the world.
    rotation : tuple[float, float, float, float], 1
        Rotation from its own frame's axes to the world's.
    endless : bool
        A plane.
    low : tuple[float, float, float], m
        Its box in the world; of a plane −inf and inf.
    high : tuple[float, float, float], m
        Its box in the world; of a plane −inf and inf.
    """
    __slots__ = ("name", "class_name", "position", "rotation", "endless", "low", "high")
    name: str
    class_name: str
    position: tuple[float, float, float]
    rotation: tuple[float, float, float, float]
    endless: bool
    low: tuple[float, float, float]
    high: tuple[float, float, float]

    def __init__(
        self,
        *,
        name: str = '',
        class_name: str = '',
        position: tuple[float, float, float] = (0.0, 0.0, 0.0),
        rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0),
        endless: bool = False,
        low: tuple[float, float, float] = (0.0, 0.0, 0.0),
        high: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        self.name = name
        self.class_name = class_name
        self.position = position
        self.rotation = rotation
        self.endless = endless
        self.low = low
        self.high = high


class ObjectInView(Record):
    """What one object is to the camera, at one time. The camera looks along z of its frame.

    Attributes
    ----------
    object : int
        Index in Scene::objects.
    name : str
        As messages call it: "objects.2 (ball)".
    pixels : int
        Pixels that see it.
    nearest_m : float | None, m
        Range of the nearest pixel that sees it; none where no pixel does.
    farthest_m : float | None, m
        Range of the farthest pixel that sees it; none where no pixel does.
    endless : bool
        A plane.
    low : tuple[float, float, float], m
        Its box in the world; of a plane −inf and inf.
    high : tuple[float, float, float], m
        Its box in the world; of a plane −inf and inf.
    behind_camera : bool
        All of it has z < 0 in the camera's frame.
    around_camera : bool
        The camera stands inside; of a mesh: its triangles surround the camera, by their solid
        angle.
    """
    __slots__ = ("object", "name", "pixels", "nearest_m", "farthest_m", "endless", "low", "high", "behind_camera", "around_camera")
    object: int
    name: str
    pixels: int
    nearest_m: float | None
    farthest_m: float | None
    endless: bool
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    behind_camera: bool
    around_camera: bool

    def __init__(
        self,
        *,
        object: int = 0,
        name: str = '',
        pixels: int = 0,
        nearest_m: float | None = None,
        farthest_m: float | None = None,
        endless: bool = False,
        low: tuple[float, float, float] = (0.0, 0.0, 0.0),
        high: tuple[float, float, float] = (0.0, 0.0, 0.0),
        behind_camera: bool = False,
        around_camera: bool = False,
    ) -> None:
        self.object = object
        self.name = name
        self.pixels = pixels
        self.nearest_m = nearest_m
        self.farthest_m = farthest_m
        self.endless = endless
        self.low = low
        self.high = high
        self.behind_camera = behind_camera
        self.around_camera = around_camera


class SceneFinding(Record):
    """Something about a scene that is seldom meant.

    Attributes
    ----------
    kind : Literal["no_objects", "nothing_in_view", "behind_camera", "millimetres", "mesh_size", "around_camera", "floor_above", "same_place", "inside_another", "beyond_reach"]
    warning : bool
        false: a note; it may well be meant.
    objects : list[int]
        Indices in Scene::objects.
    where : str
        file:line:col of the first of them; empty if built in code.
    what : str
        One line, complete in itself.
    more : str
        What it means and how to mend it, one line.
    """
    __slots__ = ("kind", "warning", "objects", "where", "what", "more")
    kind: Literal["no_objects", "nothing_in_view", "behind_camera", "millimetres", "mesh_size", "around_camera", "floor_above", "same_place", "inside_another", "beyond_reach"]
    warning: bool
    objects: list[int]
    where: str
    what: str
    more: str

    def __init__(
        self,
        *,
        kind: Literal["no_objects", "nothing_in_view", "behind_camera", "millimetres", "mesh_size", "around_camera", "floor_above", "same_place", "inside_another", "beyond_reach"]
        = 'no_objects',
        warning: bool = True,
        objects: Sequence[int] = (),
        where: str = '',
        what: str = '',
        more: str = '',
    ) -> None:
        self.kind = kind
        self.warning = warning
        self.objects = list(objects)
        self.where = where
        self.what = what
        self.more = more


class SceneReport(Record):
    """What the camera sees of the scene at one time.

    Attributes
    ----------
    time_s : float, s
        Time of the scene.
    pixels : int
        Pixels of the image.
    outside_lens : int
        Pixels without a ray.
    no_surface : int
        Pixels whose ray hits nothing.
    beyond_reach : int
        Pixels that see what is farther than the ambiguity range.
    ambiguity_range_m : float, m
        Ambiguity range of the camera's mode; 0 where no raw frame is lit.
    nearest_m : float | None, m
        Least range of all pixels; none where no ray hits anything.
    farthest_m : float | None, m
        Largest range of all pixels; none where no ray hits anything.
    objects : list[ObjectInView]
        One for each of Scene::objects.
    findings : list[SceneFinding]
    """
    __slots__ = ("time_s", "pixels", "outside_lens", "no_surface", "beyond_reach", "ambiguity_range_m", "nearest_m", "farthest_m",
                 "objects", "findings")
    time_s: float
    pixels: int
    outside_lens: int
    no_surface: int
    beyond_reach: int
    ambiguity_range_m: float
    nearest_m: float | None
    farthest_m: float | None
    objects: list[ObjectInView]
    findings: list[SceneFinding]

    def __init__(
        self,
        *,
        time_s: float = 0.0,
        pixels: int = 0,
        outside_lens: int = 0,
        no_surface: int = 0,
        beyond_reach: int = 0,
        ambiguity_range_m: float = 0.0,
        nearest_m: float | None = None,
        farthest_m: float | None = None,
        objects: Sequence[ObjectInView] = (),
        findings: Sequence[SceneFinding] = (),
    ) -> None:
        self.time_s = time_s
        self.pixels = pixels
        self.outside_lens = outside_lens
        self.no_surface = no_surface
        self.beyond_reach = beyond_reach
        self.ambiguity_range_m = ambiguity_range_m
        self.nearest_m = nearest_m
        self.farthest_m = farthest_m
        self.objects = list(objects)
        self.findings = list(findings)


class InvalidPixels(Record):
    """How many pixels have no depth, and why: each counts once, under the member of its NoDepth. What
    has low signal or no return is counted as such where there is no truth.

    Attributes
    ----------
    pixels : int
        Pixels of the image.
    valid : int
        Pixels that have a depth.
    wrapped : int
        Valid ones whose surface is beyond the ambiguity range: their depth is too small.
    valid_on_wrong_cycle : int
        Valid ones whose range is off by more than half a cycle of the highest modulation frequency.
    no_surface : int
        The ray hits nothing.
    beyond_reach : int
        The surface is farther than the ambiguity range.
    dark : int
        There is a surface within reach, and too little light comes back.
    wrong_cycle : int
        Most neighbours are off by whole cycles of a modulation frequency.
    outside_lens : int
        The lens model has no ray there.
    saturated : int
        A well or the ADC is full.
    no_return : int
        No light came back.
    low_signal : int
        The noise is above camera.decoding.noise_threshold.
    flying_pixel : int
        Its range lies between those of its neighbours.
    inconsistent_phases : int
        The raw frames of one modulation frequency do not fit together.
    inconsistent_frequencies : int
        The ranges of the modulation frequencies do not fit together.
    ambiguity_range_m : float, m
        Ambiguity range of the camera's mode; 0 where no raw frame is lit.
    ranges_m : list[float], m
        Ambiguity range of each modulation frequency alone.
    """
    __slots__ = ("pixels", "valid", "wrapped", "valid_on_wrong_cycle", "no_surface", "beyond_reach", "dark", "wrong_cycle",
                 "outside_lens", "saturated", "no_return", "low_signal", "flying_pixel", "inconsistent_phases",
                 "inconsistent_frequencies", "ambiguity_range_m", "ranges_m")
    pixels: int
    valid: int
    wrapped: int
    valid_on_wrong_cycle: int
    no_surface: int
    beyond_reach: int
    dark: int
    wrong_cycle: int
    outside_lens: int
    saturated: int
    no_return: int
    low_signal: int
    flying_pixel: int
    inconsistent_phases: int
    inconsistent_frequencies: int
    ambiguity_range_m: float
    ranges_m: list[float]

    def __init__(
        self,
        *,
        pixels: int = 0,
        valid: int = 0,
        wrapped: int = 0,
        valid_on_wrong_cycle: int = 0,
        no_surface: int = 0,
        beyond_reach: int = 0,
        dark: int = 0,
        wrong_cycle: int = 0,
        outside_lens: int = 0,
        saturated: int = 0,
        no_return: int = 0,
        low_signal: int = 0,
        flying_pixel: int = 0,
        inconsistent_phases: int = 0,
        inconsistent_frequencies: int = 0,
        ambiguity_range_m: float = 0.0,
        ranges_m: Sequence[float] = (),
    ) -> None:
        self.pixels = pixels
        self.valid = valid
        self.wrapped = wrapped
        self.valid_on_wrong_cycle = valid_on_wrong_cycle
        self.no_surface = no_surface
        self.beyond_reach = beyond_reach
        self.dark = dark
        self.wrong_cycle = wrong_cycle
        self.outside_lens = outside_lens
        self.saturated = saturated
        self.no_return = no_return
        self.low_signal = low_signal
        self.flying_pixel = flying_pixel
        self.inconsistent_phases = inconsistent_phases
        self.inconsistent_frequencies = inconsistent_frequencies
        self.ambiguity_range_m = ambiguity_range_m
        self.ranges_m = list(ranges_m)


class AmbientCase(Record):
    """Light that is not the camera's own, by the name that tables call it.

    Attributes
    ----------
    name : str
        Name in tables.
    ambient : Ambient
        none: darkness.
    pose : Pose
        Pose of the camera, where the ambient light has a direction.
    """
    __slots__ = ("name", "ambient", "pose")
    name: str
    ambient: Ambient
    pose: Pose

    def __init__(
        self,
        *,
        name: str = 'in the dark',
        ambient: Ambient | None = None,
        pose: Pose | None = None,
    ) -> None:
        self.name = name
        self.ambient = Ambient() if ambient is None else ambient
        self.pose = Pose() if pose is None else pose


class CameraQuestion(Record):
    """What a camera report is asked.

    Attributes
    ----------
    distances_m : list[float], m
        z on the optical axis, 1e-3 to 1e5; empty: 0.5, 1, 2 and 4 m.
    reflectivities : list[float], 1
        Reflectivities of a matt surface that faces the camera, 0 to 1; empty: 0.2 and 0.8.
    ambients : list[AmbientCase]
        empty: darkness, and all of the standard sun (100 % of sun_am15) from everywhere.
    """
    __slots__ = ("distances_m", "reflectivities", "ambients")
    distances_m: list[float]
    reflectivities: list[float]
    ambients: list[AmbientCase]

    def __init__(
        self,
        *,
        distances_m: Sequence[float] = (),
        reflectivities: Sequence[float] = (),
        ambients: Sequence[AmbientCase] = (),
    ) -> None:
        self.distances_m = list(distances_m)
        self.reflectivities = list(reflectivities)
        self.ambients = list(ambients)


class NoiseAt(Record):
    """Range noise and wrong cycles at one distance.

    Attributes
    ----------
    z_m : float, m
        Distance on the optical axis.
    sigma_m : float, m
        Standard deviation of the range, expected; NaN: nothing comes back [theory: noise-estimate].
    wrong_cycle : float, 1
        Share of pixels whose range is whole cycles off, whatever flag they get: how often noise
        makes unwrapping choose another cycle, of phases that have the exact density of a noisy
        phasor's. 0 with one modulation frequency; NaN where there is no phase.
        [theory: noisy-phasor, wrong-cycle-share].
    saturated : bool
        There is no depth.
    """
    __slots__ = ("z_m", "sigma_m", "wrong_cycle", "saturated")
    z_m: float
    sigma_m: float
    wrong_cycle: float
    saturated: bool

    def __init__(
        self,
        *,
        z_m: float = 0.0,
        sigma_m: float = 0.0,
        wrong_cycle: float = 0.0,
        saturated: bool = False,
    ) -> None:
        self.z_m = z_m
        self.sigma_m = sigma_m
        self.wrong_cycle = wrong_cycle
        self.saturated = saturated


class NoiseAtDistances(Record):
    """Range noise and wrong cycles on the optical axis, of a matt surface that faces the camera.

    Attributes
    ----------
    reflectivity : float, 1
        Reflectivity of the surface.
    ambient : str
        Name of the light that is not the camera's own.
    saturated_up_to_m : float, m
        Largest distance at which it saturates; 0: none from 5 cm on; everywhere_m: all distances.
    at : list[NoiseAt]
        One for each distance.
    """
    __slots__ = ("reflectivity", "ambient", "saturated_up_to_m", "at")
    reflectivity: float
    ambient: str
    saturated_up_to_m: float
    at: list[NoiseAt]

    def __init__(
        self,
        *,
        reflectivity: float = 0.0,
        ambient: str = '',
        saturated_up_to_m: float = 0.0,
        at: Sequence[NoiseAt] = (),
    ) -> None:
        self.reflectivity = reflectivity
        self.ambient = ambient
        self.saturated_up_to_m = saturated_up_to_m
        self.at = list(at)


class CameraReport(Record):
    """What a camera can do in its mode.

    Attributes
    ----------
    width : int
        Size of the image in pixels.
    height : int
        Size of the image in pixels.
    width_deg : float, deg
        Field of view between the outer edges of the outermost pixels, through the middle.
    height_deg : float, deg
        Field of view between the outer edges of the outermost rows, through the middle.
    diagonal_deg : float, deg
        Field of view from corner to corner.
    pixel_width_m : float, m
        Width that one pixel sees at 1 m on the axis.
    pixel_height_m : float, m
        Height that one pixel sees at 1 m on the axis.
    outside : float, 1
        Share of the pixels that are outside the lens model.
    unlit : float, 1
        Share of those that get less than a millionth of the brightest one's light of a wall at 1 m.
    darkest : float, 1
        Signal of the darkest lit pixel over the brightest one's, of that wall.
    modulation_frequency_hz : list[float], Hz
        Modulation frequencies of the mode.
    cycles : list[int]
        Cycles of each of them in the ambiguity range: M and N of two.
    ambiguity_range_m : float, m
        Ambiguity range of the mode; 0 where no raw frame is lit.
    low_signal_m : float, m
        σ above this is flagged.
    knows_ambient : bool
        An unlit raw frame tells the camera how much noise ambient light makes.
    noise : list[NoiseAtDistances]
        Ambient by ambient, in each by reflectivity; empty: no raw frame is lit, or no light.
    warnings : list[str]
        About the design, a line each.
    """
    __slots__ = ("width", "height", "width_deg", "height_deg", "diagonal_deg", "pixel_width_m", "pixel_height_m", "outside", "unlit",
                 "darkest", "modulation_frequency_hz", "cycles", "ambiguity_range_m", "low_signal_m", "knows_ambient", "noise",
                 "warnings")
    width: int
    height: int
    width_deg: float
    height_deg: float
    diagonal_deg: float
    pixel_width_m: float
    pixel_height_m: float
    outside: float
    unlit: float
    darkest: float
    modulation_frequency_hz: list[float]
    cycles: list[int]
    ambiguity_range_m: float
    low_signal_m: float
    knows_ambient: bool
    noise: list[NoiseAtDistances]
    warnings: list[str]

    def __init__(
        self,
        *,
        width: int = 0,
        height: int = 0,
        width_deg: float = 0.0,
        height_deg: float = 0.0,
        diagonal_deg: float = 0.0,
        pixel_width_m: float = 0.0,
        pixel_height_m: float = 0.0,
        outside: float = 0.0,
        unlit: float = 0.0,
        darkest: float = 0.0,
        modulation_frequency_hz: Sequence[float] = (),
        cycles: Sequence[int] = (),
        ambiguity_range_m: float = 0.0,
        low_signal_m: float = 0.0,
        knows_ambient: bool = True,
        noise: Sequence[NoiseAtDistances] = (),
        warnings: Sequence[str] = (),
    ) -> None:
        self.width = width
        self.height = height
        self.width_deg = width_deg
        self.height_deg = height_deg
        self.diagonal_deg = diagonal_deg
        self.pixel_width_m = pixel_width_m
        self.pixel_height_m = pixel_height_m
        self.outside = outside
        self.unlit = unlit
        self.darkest = darkest
        self.modulation_frequency_hz = list(modulation_frequency_hz)
        self.cycles = list(cycles)
        self.ambiguity_range_m = ambiguity_range_m
        self.low_signal_m = low_signal_m
        self.knows_ambient = knows_ambient
        self.noise = list(noise)
        self.warnings = list(warnings)


class ChainRawFrame(Record):
    """One pixel in one raw frame.

    Attributes
    ----------
    lit : bool
    modulation_frequency_hz : float, Hz
    reference_phase_rad : float, rad
    integration_time_s : float, s
    signal_e : float, e
        Ground truth S, both taps.
    direct_e : float, e
        Electrons by one surface and by several, before the lens scatters them.
    indirect_e : float, e
        Electrons by one surface and by several, before the lens scatters them.
    multipath_m : float, m
        What that does to the half path [theory: multipath-error].
    path_noise_m : float, m
        The standard error of that [theory: path-noise].
    tap_a_e : float, e
    tap_b_e : float, e
    code_dn : float, DN
    difference_e : float, e
        D_k that depth comes from: out of the code, or unrounded where noise is off.
    """
    __slots__ = ("lit", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "signal_e", "direct_e", "indirect_e",
                 "multipath_m", "path_noise_m", "tap_a_e", "tap_b_e", "code_dn", "difference_e")
    lit: bool
    modulation_frequency_hz: float
    reference_phase_rad: float
    integration_time_s: float
    signal_e: float
    direct_e: float
    indirect_e: float
    multipath_m: float
    path_noise_m: float
    tap_a_e: float
    tap_b_e: float
    code_dn: float
    difference_e: float

    def __init__(
        self,
        *,
        lit: bool = False,
        modulation_frequency_hz: float = 0.0,
        reference_phase_rad: float = 0.0,
        integration_time_s: float = 0.0,
        signal_e: float = 0.0,
        direct_e: float = 0.0,
        indirect_e: float = 0.0,
        multipath_m: float = 0.0,
        path_noise_m: float = 0.0,
        tap_a_e: float = 0.0,
        tap_b_e: float = 0.0,
        code_dn: float = 0.0,
        difference_e: float = 0.0,
    ) -> None:
        self.lit = lit
        self.modulation_frequency_hz = modulation_frequency_hz
        self.reference_phase_rad = reference_phase_rad
        self.integration_time_s = integration_time_s
        self.signal_e = signal_e
        self.direct_e = direct_e
        self.indirect_e = indirect_e
        self.multipath_m = multipath_m
        self.path_noise_m = path_noise_m
        self.tap_a_e = tap_a_e
        self.tap_b_e = tap_b_e
        self.code_dn = code_dn
        self.difference_e = difference_e


class ChainPhase(Record):
    """One pixel's phase at one modulation frequency.

    Attributes
    ----------
    modulation_frequency_hz : float, Hz
    amplitude_e : float, e
        |Z| [theory: phase-estimate].
    measured_turns : float, turns
        Arg Z / 2 pi, with the wiggling in it.
    calibrated_turns : float, turns
        With the wiggling and the pixel's delay taken out [theory: wiggling-correction].
    half_wave_m : float, m
        R, the unambiguous half path [theory: half-path].
    cycles : float, 1
        Whole cycles that unwrapping added.
    half_path_m : float, m
        R (cycles + turns).
    noise_e : float, e
        1 sigma of each part of Z, as the camera estimates it [theory: noise-estimate].
    """
    __slots__ = ("modulation_frequency_hz", "amplitude_e", "measured_turns", "calibrated_turns", "half_wave_m", "cycles", "half_path_m",
                 "noise_e")
    modulation_frequency_hz: float
    amplitude_e: float
    measured_turns: float
    calibrated_turns: float
    half_wave_m: float
    cycles: float
    half_path_m: float
    noise_e: float

    def __init__(
        self,
        *,
        modulation_frequency_hz: float = 0.0,
        amplitude_e: float = 0.0,
        measured_turns: float = 0.0,
        calibrated_turns: float = 0.0,
        half_wave_m: float = 0.0,
        cycles: float = 0.0,
        half_path_m: float = 0.0,
        noise_e: float = 0.0,
    ) -> None:
        self.modulation_frequency_hz = modulation_frequency_hz
        self.amplitude_e = amplitude_e
        self.measured_turns = measured_turns
        self.calibrated_turns = calibrated_turns
        self.half_wave_m = half_wave_m
        self.cycles = cycles
        self.half_path_m = half_path_m
        self.noise_e = noise_e


class UnwrapCandidate(Record):
    """One way to unwrap: a cycle of the modulation frequency with the fewest, and of each other one
    the half path nearest to it.

    Attributes
    ----------
    cycles : list[float], 1
        Whole cycles of each of the chain's phases.
    range_m : float, m
        That they mean [theory: fusion, range-and-z].
    cost_m2 : float, m2
        Sum of the squares of how far the other half paths are off [theory: unwrapping].
    chosen : bool
        Its cost is the least: what unwrapping takes.
    """
    __slots__ = ("cycles", "range_m", "cost_m2", "chosen")
    cycles: list[float]
    range_m: float
    cost_m2: float
    chosen: bool

    def __init__(
        self,
        *,
        cycles: Sequence[float] = (),
        range_m: float = 0.0,
        cost_m2: float = 0.0,
        chosen: bool = False,
    ) -> None:
        self.cycles = list(cycles)
        self.range_m = range_m
        self.cost_m2 = cost_m2
        self.chosen = chosen


class PixelChain(Record):
    """One pixel's way from light to depth. What the arrays do not have is NaN or empty.

    Attributes
    ----------
    u : int
    v : int
    object : int
    true_range_m : float, m
    true_z_m : float, m
    reflectivity : float, 1
        Reflectivity of the surface.
    incidence_rad : float, rad
    object_share : float, 1
        Truth of samples within the pixel.
    mixed : float, 1
        Truth of samples within the pixel.
    position_m : tuple[float, float, float], m
    normal : tuple[float, float, float], 1
        Normal of unit length.
    irradiance_w_m2 : float, W/m2
        Irradiance on the surface.
    radiance_w_m2_sr : float, W/(m2 sr)
        Radiance back from it.
    power_w : float, W
        Power on the pixel.
    raw_frames : list[ChainRawFrame]
    phases : list[ChainPhase]
        One for each modulation frequency.
    candidates : list[UnwrapCandidate]
        Of all cycles, by cost, the one chosen first; empty where there is one modulation frequency,
        no phase or no camera.
    range_m : float, m
    z_m : float, m
    noise_m : float, m
    noise_threshold_m : float, m
    amplitude_e : float, e
    ambient_e : float, e
    confidence : float, 1
        0 to 255.
    point_m : tuple[float, float, float], m
    flags : int
        Bits of Flag.
    """
    __slots__ = ("u", "v", "object", "true_range_m", "true_z_m", "reflectivity", "incidence_rad", "object_share", "mixed", "position_m",
                 "normal", "irradiance_w_m2", "radiance_w_m2_sr", "power_w", "raw_frames", "phases", "candidates", "range_m", "z_m",
                 "noise_m", "noise_threshold_m", "amplitude_e", "ambient_e", "confidence", "point_m", "flags")
    u: int
    v: int
    object: int
    true_range_m: float
    true_z_m: float
    reflectivity: float
    incidence_rad: float
    object_share: float
    mixed: float
    position_m: tuple[float, float, float]
    normal: tuple[float, float, float]
    irradiance_w_m2: float
    radiance_w_m2_sr: float
    power_w: float
    raw_frames: list[ChainRawFrame]
    phases: list[ChainPhase]
    candidates: list[UnwrapCandidate]
    range_m: float
    z_m: float
    noise_m: float
    noise_threshold_m: float
    amplitude_e: float
    ambient_e: float
    confidence: float
    point_m: tuple[float, float, float]
    flags: int

    def __init__(
        self,
        *,
        u: int = 0,
        v: int = 0,
        object: int = -1,
        true_range_m: float = 0.0,
        true_z_m: float = 0.0,
        reflectivity: float = 0.0,
        incidence_rad: float = 0.0,
        object_share: float = 0.0,
        mixed: float = 0.0,
        position_m: tuple[float, float, float] = (0.0, 0.0, 0.0),
        normal: tuple[float, float, float] = (0.0, 0.0, 0.0),
        irradiance_w_m2: float = 0.0,
        radiance_w_m2_sr: float = 0.0,
        power_w: float = 0.0,
        raw_frames: Sequence[ChainRawFrame] = (),
        phases: Sequence[ChainPhase] = (),
        candidates: Sequence[UnwrapCandidate] = (),
        range_m: float = 0.0,
        z_m: float = 0.0,
        noise_m: float = 0.0,
        noise_threshold_m: float = 0.0,
        amplitude_e: float = 0.0,
        ambient_e: float = 0.0,
        confidence: float = 0.0,
        point_m: tuple[float, float, float] = (0.0, 0.0, 0.0),
        flags: int = 0,
    ) -> None:
        self.u = u
        self.v = v
        self.object = object
        self.true_range_m = true_range_m
        self.true_z_m = true_z_m
        self.reflectivity = reflectivity
        self.incidence_rad = incidence_rad
        self.object_share = object_share
        self.mixed = mixed
        self.position_m = position_m
        self.normal = normal
        self.irradiance_w_m2 = irradiance_w_m2
        self.radiance_w_m2_sr = radiance_w_m2_sr
        self.power_w = power_w
        self.raw_frames = list(raw_frames)
        self.phases = list(phases)
        self.candidates = list(candidates)
        self.range_m = range_m
        self.z_m = z_m
        self.noise_m = noise_m
        self.noise_threshold_m = noise_threshold_m
        self.amplitude_e = amplitude_e
        self.ambient_e = ambient_e
        self.confidence = confidence
        self.point_m = point_m
        self.flags = flags


class BounceShare(Record):
    """Light that came by way of 1 + b surfaces, b = first … last.

    Attributes
    ----------
    first : int
    last : int
    share : float, 1
        Share of the electrons of all lit raw frames, 0 … 1.
    electrons : list[float], e
        Electrons by raw frame, before the lens scatters them.
    multipath_m : list[float], m
        By raw frame: what it adds to the half path once all before it are there.
    """
    __slots__ = ("first", "last", "share", "electrons", "multipath_m")
    first: int
    last: int
    share: float
    electrons: list[float]
    multipath_m: list[float]

    def __init__(
        self,
        *,
        first: int = 0,
        last: int = 0,
        share: float = 0.0,
        electrons: Sequence[float] = (),
        multipath_m: Sequence[float] = (),
    ) -> None:
        self.first = first
        self.last = last
        self.share = share
        self.electrons = list(electrons)
        self.multipath_m = list(multipath_m)


class PixelBounces(Record):
    """One pixel's light, bounce by bounce. Light paths are chosen by pixel, bounce and sample alone,
    so that frames with fewer bounces follow the beginnings of the same paths: what a bounce adds is
    the difference of two frames, without Monte Carlo error between them.

    Attributes
    ----------
    shares : list[BounceShare]
        Direct light first; together gt_direct_e + gt_indirect_e and gt_multipath_m; may be empty.
    unknown : str
        Why it is empty although light bounced.
    """
    __slots__ = ("shares", "unknown")
    shares: list[BounceShare]
    unknown: str

    def __init__(
        self,
        *,
        shares: Sequence[BounceShare] = (),
        unknown: str = '',
    ) -> None:
        self.shares = list(shares)
        self.unknown = unknown


class Validity(Record):
    """Why pixels have no depth, in words, and what helps.

    Attributes
    ----------
    pixels : InvalidPixels
    reasons : str
        "12 dark, 3 no surface"; empty where all are valid.
    advice : str
        Where fewer than half are valid, the reason of most, and what helps: "71 % dark: noise 0.11
        m at the median; more light …"; also where many have a depth that is whole cycles off. Lines
        behind the first are indented.
    has_light : bool
        The camera's own has any power.
    """
    __slots__ = ("pixels", "reasons", "advice", "has_light")
    pixels: InvalidPixels
    reasons: str
    advice: str
    has_light: bool

    def __init__(
        self,
        *,
        pixels: InvalidPixels | None = None,
        reasons: str = '',
        advice: str = '',
        has_light: bool = True,
    ) -> None:
        self.pixels = InvalidPixels() if pixels is None else pixels
        self.reasons = reasons
        self.advice = advice
        self.has_light = has_light


class InputFile(Record):
    """A file that a run starts from, as manifest.json lists it.

    Attributes
    ----------
    role : str
        "scene", "profile", "table", "mesh", "keyframes", ….
    name : str
        Name by the caller or the scene; a built-in name where `text` is empty.
    text : str
        The whole file, UTF-8; empty for what is built in, and for meshes and keyframes.
    sha256 : str
        SHA-256 of a mesh and of keyframes, which may be too long to be here.
    """
    __slots__ = ("role", "name", "text", "sha256")
    role: str
    name: str
    text: str
    sha256: str

    def __init__(
        self,
        *,
        role: str = '',
        name: str = '',
        text: str = '',
        sha256: str = '',
    ) -> None:
        self.role = role
        self.name = name
        self.text = text
        self.sha256 = sha256


class Remark(Record):
    """Something worth telling of what goes on all the same.

    Attributes
    ----------
    warning : bool
        false: a note.
    where : str
        The file it is about, or nothing.
    what : str
        One line, complete in itself.
    more : str
        What it means and how to mend it, one line; may be empty.
    """
    __slots__ = ("warning", "where", "what", "more")
    warning: bool
    where: str
    what: str
    more: str

    def __init__(
        self,
        *,
        warning: bool = True,
        where: str = '',
        what: str = '',
        more: str = '',
    ) -> None:
        self.warning = warning
        self.where = where
        self.what = what
        self.more = more


class Inputs(Record):
    """Scene and camera, ready for a Simulator.

    Attributes
    ----------
    scene : Scene
    camera : Camera
    files : list[InputFile]
        The scene first.
    remarks : list[Remark]
        Remarks on the inputs, which can be simulated all the same.
    """
    __slots__ = ("scene", "camera", "files", "remarks")
    scene: Scene
    camera: Camera
    files: list[InputFile]
    remarks: list[Remark]

    def __init__(
        self,
        *,
        scene: Scene | None = None,
        camera: Camera | None = None,
        files: Sequence[InputFile] = (),
        remarks: Sequence[Remark] = (),
    ) -> None:
        self.scene = Scene() if scene is None else scene
        self.camera = Camera() if camera is None else camera
        self.files = list(files)
        self.remarks = list(remarks)


class FileRecord(Record):
    """A file that a run has written.

    Attributes
    ----------
    name : str
        Within the folder.
    bytes : int
    sha256 : str
        64 hexadecimal digits.
    """
    __slots__ = ("name", "bytes", "sha256")
    name: str
    bytes: int
    sha256: str

    def __init__(
        self,
        *,
        name: str = '',
        bytes: int = 0,
        sha256: str = '',
    ) -> None:
        self.name = name
        self.bytes = bytes
        self.sha256 = sha256


class RunResult(Record):
    """How a run went.

    Attributes
    ----------
    folder : str
    files : list[FileRecord]
        Manifest.json last.
    frames : int
        Number of complete frames.
    interrupted : bool
        Fewer than were asked for.
    remarks : list[Remark]
        Remarks on the inputs, the scene as the camera sees it, the frames, the folder.
    last : Validity
        Validity of the last frame's depth.
    ran_on : RanOn
    timings_s : list[tuple[str, float]], s
        Seconds by stage: prepare, simulate, write.
    """
    __slots__ = ("folder", "files", "frames", "interrupted", "remarks", "last", "ran_on", "timings_s")
    folder: str
    files: list[FileRecord]
    frames: int
    interrupted: bool
    remarks: list[Remark]
    last: Validity
    ran_on: RanOn
    timings_s: list[tuple[str, float]]

    def __init__(
        self,
        *,
        folder: str = '',
        files: Sequence[FileRecord] = (),
        frames: int = 0,
        interrupted: bool = False,
        remarks: Sequence[Remark] = (),
        last: Validity | None = None,
        ran_on: RanOn | None = None,
        timings_s: Sequence[tuple[str, float]] = (),
    ) -> None:
        self.folder = folder
        self.files = list(files)
        self.frames = frames
        self.interrupted = interrupted
        self.remarks = list(remarks)
        self.last = Validity() if last is None else last
        self.ran_on = RanOn() if ran_on is None else ran_on
        self.timings_s = list(timings_s)


__all__ = [
    "PixelMask", "Sensor", "Curve", "Scatter", "Lens", "Filter", "Area", "Pattern", "Waveform",
    "Illumination", "Pixel", "Adc", "ImageFilter", "FrequencyCalibration", "DecoderCalibration",
    "Decoding", "Temperature", "Interference", "Calibration", "SpreadSpectrum", "Readout",
    "AutoExposure", "RawFrame", "Mode", "Camera", "Pose", "CameraKeyframe", "Override",
    "CameraChoice", "Ambient", "TransientBins", "Transport", "Material", "Plane", "Sphere", "Box",
    "Triangle", "Cylinder", "Rectangle", "Disk", "Capsule", "Cone", "Mesh", "Rotation", "Keyframe",
    "Object", "SceneFile", "Scene", "RanOn", "PlanStep", "Pinhole", "Placement", "PlacedObject",
    "FrameRequest", "ObjectPlace", "ObjectInView", "SceneFinding", "SceneReport", "InvalidPixels",
    "AmbientCase", "CameraQuestion", "NoiseAt", "NoiseAtDistances", "CameraReport", "ChainRawFrame",
    "ChainPhase", "UnwrapCandidate", "PixelChain", "BounceShare", "PixelBounces", "Validity",
    "InputFile", "Remark", "Inputs", "FileRecord", "RunResult",
]
