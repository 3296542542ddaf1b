"""From a program to text: one folder per language, no physics.

To add a backend ``x``:

1. ``emit/x/``: a printer, that is :class:`tmm_gen.emit.expressions.ExpressionPrinter` with the language's way
   of writing numbers and references, and a printer of statements and loops;
2. ``emit_x(program, scene)``, which returns texts by path inside the package; every file carries the lines of
   :func:`tmm_gen.emit.header.header_lines`, and is passed through :func:`tmm_gen.emit.seal.sealed`;
3. ``templates/x/``: signatures and frames of loops, thin; the mathematics comes from the program;
4. one line in :data:`tmm_gen.backends.OWN`, or, in a package of your own, an entry point of
   the group ``tmm_gen.backends``;
5. ``tests/emit/x/`` for the printers, and ``tests/generated/``: agreement with the interpreter after a step.
"""
