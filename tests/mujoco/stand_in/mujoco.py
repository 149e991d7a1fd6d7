# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Stands in for MuJoCo's Python binding, which Debian lacks: the attributes that examples/mujoco takes, over the real libmujoco, by ctypes.

Names, shapes and types are those that bindings of 2.2.2 and of 3 share. TOFRAY_MUJOCO_BINDING names binding.c as a shared library.
"""

import ctypes
import enum
import os

import numpy as np

_library = ctypes.CDLL(os.environ["TOFRAY_MUJOCO_BINDING"])
_TYPES = {b"mjtNum": np.float64, b"float": np.float32, b"int": np.int32, b"mjtByte": np.uint8}


class _Found(ctypes.Structure):
    _fields_ = [("type", ctypes.c_char_p), ("data", ctypes.c_void_p), ("rows", ctypes.c_int), ("columns", ctypes.c_int)]


def _function(name, result, *arguments):
    function = getattr(_library, name)
    function.restype, function.argtypes = result, arguments
    return function


_pointer, _int, _text = ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p
_numbers = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
_model_member = _function("model_member", _Found, _pointer, _text)
_data_member = _function("data_member", _Found, _pointer, _pointer, _text)
_timestep_of = _function("timestep_of", ctypes.POINTER(ctypes.c_double), _pointer)
_load = _function("mj_loadXML", _pointer, _text, _pointer, _text, _int)
_delete_model, _delete_data = _function("mj_deleteModel", None, _pointer), _function("mj_deleteData", None, _pointer)
_make_data = _function("mj_makeData", _pointer, _pointer)
_step, _forward = (_function(name, None, _pointer, _pointer) for name in ("mj_step", "mj_forward"))
_id2name, _name2id = _function("mj_id2name", _text, _pointer, _int, _int), _function("mj_name2id", _int, _pointer, _int, _text)
_mat2quat = _function("mju_mat2Quat", None, _numbers, _numbers)
_meet = _function("meet", None, _pointer, _pointer, _numbers, _numbers, _int, np.ctypeslib.ndpointer(np.int32), _numbers)


class mjtGeom(enum.Enum):   # which is no int, as the binding's are not
    mjGEOM_PLANE, mjGEOM_HFIELD, mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_ELLIPSOID, mjGEOM_CYLINDER, mjGEOM_BOX, mjGEOM_MESH = range(8)

    def __int__(self):
        return self.value


class mjtObj(enum.Enum):
    mjOBJ_GEOM, mjOBJ_CAMERA, mjOBJ_MATERIAL = 5, 7, 13

    def __int__(self):
        return self.value


def _array(found, name, owner):
    """Looks into MuJoCo's memory: what is written there, MuJoCo has."""
    if found.type is None:
        raise AttributeError(name)
    shape = (found.rows, found.columns) if found.columns > 1 else (found.rows,)
    kind = np.dtype(_TYPES[found.type])
    count = max(1, int(np.prod(shape))) * kind.itemsize
    memory = (ctypes.c_char * count).from_address(found.data) if found.data else bytes(count)
    array = np.frombuffer(memory, kind, count=int(np.prod(shape))).reshape(shape)
    memory.owner = owner
    return array


class _Options:
    def __init__(self, model):
        self._model = model

    @property
    def timestep(self):
        return _timestep_of(self._model._at)[0]

    @timestep.setter
    def timestep(self, value):
        _timestep_of(self._model._at)[0] = value


class MjModel:
    def __init__(self, at):
        self._at, self.opt = at, _Options(self)

    @staticmethod
    def from_xml_path(path):
        fault = ctypes.create_string_buffer(1000)
        at = _load(os.fsencode(path), None, ctypes.cast(fault, _text), len(fault))
        if not at:
            raise ValueError(fault.value.decode())
        return MjModel(at)

    def __del__(self):
        _delete_model(self._at)

    def __getattr__(self, name):
        found = _model_member(self._at, name.encode())
        if found.type == b"int" and found.rows == 0 and name.startswith("n"):
            return ctypes.c_int.from_address(found.data).value
        return _array(found, name, self)


class MjData:
    def __init__(self, model):
        self._model, self._at = model, _make_data(model._at)

    def __del__(self):
        _delete_data(self._at)

    @property
    def time(self):
        return ctypes.c_double.from_address(_data_member(self._model._at, self._at, b"time").data).value

    def __getattr__(self, name):
        return _array(_data_member(self._model._at, self._at, name.encode()), name, self)


def mj_step(model, data):
    _step(model._at, data._at)


def mj_forward(model, data):
    _forward(model._at, data._at)


def mj_id2name(model, kind, index):
    name = _id2name(model._at, int(kind), index)
    return None if name is None else name.decode()


def mj_name2id(model, kind, name):
    return _name2id(model._at, int(kind), name.encode())


def mju_mat2Quat(quaternion, matrix):
    _mat2quat(quaternion, np.ascontiguousarray(matrix))


def meet(model, data, origin, ways):
    """Not the binding's: what each ray from a point meets, and how far on, by mj_ray."""
    ways = np.ascontiguousarray(ways, np.float64)
    geoms, distances = np.empty(len(ways), np.int32), np.empty(len(ways))
    _meet(model._at, data._at, np.ascontiguousarray(origin), ways, len(ways), geoms, distances)
    return geoms, distances
