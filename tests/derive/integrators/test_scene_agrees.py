"""Scenes know integrators as plain data; here that data meets the declarations."""

from __future__ import annotations

import inspect
from importlib import import_module

import pytest
import sympy as sp

from tmm_gen.derive.integrators.analysis import is_explicit
from tmm_gen.derive.integrators.parameters import exact
from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.scene.integrator import METHODS, Method


def test_the_same_names() -> None:
    assert sorted(method.name for method in METHODS) == list(names())


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
def test_parameters_are_declared_once(method: Method) -> None:
    """Formulas take the declared parameters by name, without a default of their own."""
    module = import_module(f"tmm_gen.derive.integrators.{method.name}")
    arguments = inspect.signature(getattr(module, method.name)).parameters
    assert list(arguments) == [p.name for p in method.parameters]
    assert all(argument.default is inspect.Parameter.empty for argument in arguments.values())
    declared = integrator(method.name).parameters
    assert {p.name: exact(p.default) for p in method.parameters} == dict(declared)


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
def test_the_same_ranges(method: Method) -> None:
    """What a scene admits is accepted, and just outside it is refused."""
    for parameter in method.parameters:
        for end, outward in ((parameter.low, -1), (parameter.high, 1)):
            if abs(end) == float("inf"):
                continue
            inside = sp.Rational(end) - outward * sp.Rational(1, 100) * int(parameter.open)
            assert parameter.admits(float(inside))
            assert integrator(method.name, **{parameter.name: inside}).parameters[parameter.name] == inside
            outside = sp.Rational(end) + outward * sp.Rational(1, 100) * int(not parameter.open)
            assert not parameter.admits(float(outside))
            with pytest.raises(ValueError, match=parameter.name):
                integrator(method.name, **{parameter.name: outside})


@pytest.mark.parametrize("method", METHODS, ids=lambda m: m.name)
def test_the_same_methods_are_explicit(method: Method) -> None:
    assert is_explicit(integrator(method.name).main) == method.explicit({})
    if method.explicit_at:
        assert is_explicit(integrator(method.name, **method.explicit_at).main)
        assert method.explicit(dict(method.explicit_at))
