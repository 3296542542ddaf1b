"""The environment of the templates: thin frames, in which an undefined name is an error."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from tmm_gen.c_language.names import macros, signal
from tmm_gen.resources import templates_dir

if TYPE_CHECKING:
    import jinja2


def render(template: str, **context: Any) -> str:
    """Fill in a template.

    Parameters
    ----------
    template : str
        Path below ``templates/``.

    Raises
    ------
    jinja2.UndefinedError
        If the template uses a name that it is not given.
    """
    return _environment().get_template(template).render(**context)


@cache
def _environment() -> jinja2.Environment:
    import jinja2  # who counts a program's operations prints nothing

    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(templates_dir()),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # code is not markup
    )
    environment.filters |= {"macros": macros, "signal": signal}
    return environment
