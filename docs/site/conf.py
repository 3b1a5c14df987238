"""Sphinx's settings; tools/docs.sh puts this beside the pages and the generated reference."""

import re

import slalom

project = "Slalom"
version = release = slalom.__version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
html_theme = "furo"
html_show_sphinx = False
html_show_copyright = False
myst_heading_anchors = 3
autodoc_member_order = "groupwise"
autodoc_default_options = {"members": True, "undoc-members": True,
                           "special-members": "__call__, __getitem__"}
add_module_names = False
python_use_unqualified_type_names = True
# Links into the source tree, which the site does not carry.
suppress_warnings = ["myst.xref_missing"]


def as_markup(line):
    """Comments of headers are plain text but for `code`."""
    parts = re.split(r"(`[^`]+`)", line)
    return "".join(f"`{p}`" if k % 2 else re.sub(r"([\\*|_])", r"\\\1", p)
                   for k, p in enumerate(parts))


def on_docstring(app, what, name, obj, options, lines):
    """Paragraphs as markup, what is indented as it stands."""
    out, formula = [], False
    for line in lines:
        indented = line.startswith("  ") and bool(line.strip())
        if indented and not formula:
            out += ["", "::", ""]
        elif formula and not indented and line.strip():
            out.append("")
        if line.strip():
            formula = indented
        out.append(line if indented else as_markup(line))
    lines[:] = out


def setup(app):
    app.connect("autodoc-process-docstring", on_docstring)
