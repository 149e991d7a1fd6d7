# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Names of the classes of _model.py, for who does not read all of it. Written by python/tools/make_model.py; do not edit."""

MODEL = (
    "Adc", "Ambient", "AmbientCase", "Area", "AutoExposure", "BounceShare", "Box", "Calibration", "Camera", "CameraChoice",
    "CameraKeyframe", "CameraQuestion", "CameraReport", "Capsule", "ChainPhase", "ChainRawFrame", "Cone", "Curve", "Cylinder",
    "DecoderCalibration", "Decoding", "Disk", "FileRecord", "Filter", "FrameRequest", "FrequencyCalibration", "Illumination",
    "ImageFilter", "InputFile", "Inputs", "Interference", "InvalidPixels", "Keyframe", "Lens", "Material", "Mesh", "Mode", "NoiseAt",
    "NoiseAtDistances", "Object", "ObjectInView", "ObjectPlace", "Override", "Pattern", "Pinhole", "Pixel", "PixelBounces",
    "PixelChain", "PixelMask", "PlacedObject", "Placement", "PlanStep", "Plane", "Pose", "RanOn", "RawFrame", "Readout", "Rectangle",
    "Remark", "Rotation", "RunResult", "Scatter", "Scene", "SceneFile", "SceneFinding", "SceneReport", "Sensor", "Sphere",
    "SpreadSpectrum", "Temperature", "TransientBins", "Transport", "Triangle", "UnwrapCandidate", "Validity", "Waveform",
)
