"""A scene's generated NumPy package, imported without a trace in the user's tree."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from tmm_gen.extras import extra
from tmm_gen.scene import Scene
from tmm_gen.scratch import scratch_folder


def numpy_module(scene: Scene, program: Any = None) -> ModuleType:
    """Generate a scene's NumPy package and import it.

    Parameters
    ----------
    scene : Scene
        What to generate.
    program : Program, optional
        That of the scene, if it is built already.

    Returns
    -------
    module
        With the generated functions ``prepare``, ``initialise``, ``step``, ``output``, ``simulate`` and what
        they take.

    Raises
    ------
    UserError
        If the scene asks for something that does not exist.
    """
    from tmm_gen.emit.numpy import emit_numpy  # loads SymPy and Jinja2

    return _imported(emit_numpy, scene, program)


def casadi_module(scene: Scene, program: Any = None) -> ModuleType:
    """Generate a scene's CasADi model and import it, as :func:`numpy_module` does.

    Its functions are ``step_function``, ``start_functions`` and ``initial_function``.
    """
    from tmm_gen.emit.casadi import emit_casadi  # loads SymPy and Jinja2

    return _imported(emit_casadi, scene, program)


def jax_module(scene: Scene, program: Any = None) -> ModuleType:
    """Generate a scene's JAX module, with the functions of :func:`numpy_module`'s, and import it.

    Raises
    ------
    UserError
        If JAX is not installed, or the scene asks for something that does not exist.
    """
    from tmm_gen.emit.jax import emit_jax  # loads SymPy and Jinja2

    extra("jax", "a kernel in JAX")
    return _imported(emit_jax, scene, program)


def _imported(emit: Callable[[Any, Scene], dict[str, str]], scene: Scene, program: Any) -> ModuleType:
    """Import what a backend of Python writes: a package, or a module that stands alone."""
    from tmm_gen.program.build import build_program

    files = emit(program or build_program(scene), scene)
    if "__init__.py" not in files:
        (text,) = files.values()
        files = {"__init__.py": text}
    return import_package(files, scene.name)


def import_package(files: dict[str, str], name: str) -> ModuleType:
    """Import a package from the texts of its files.

    Parameters
    ----------
    files : dict from str to str
        Text by path inside the package, ``__init__.py`` among them; gone once the package is imported.
    name : str
        What it is called in messages.
    """
    unique = f"_tmm_gen_{name}_{len(sys.modules)}"
    with scratch_folder() as folder:
        for path, text in files.items():
            target = Path(folder, path)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")
        spec = spec_from_file_location(
            unique, Path(folder, "__init__.py"), submodule_search_locations=[str(folder)]
        )
        assert spec is not None
        assert spec.loader is not None
        module = module_from_spec(spec)
        sys.modules[unique] = module
        try:
            spec.loader.exec_module(module)
        finally:  # whoever holds the module keeps it; nobody else is to find it
            for loaded in [key for key in sys.modules if key == unique or key.startswith(f"{unique}.")]:
                del sys.modules[loaded]
    return module
