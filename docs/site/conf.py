# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Sphinx's settings. docs/site/make.py calls it: SOURCE, DOXYGEN and VERSION come from there, by the environment."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

project = "tofray"
author = "The tofray authors"
copyright = "2026 The tofray authors"  # noqa: A001: Sphinx's name
version = release = os.environ["TOFRAY_SITE_VERSION"]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "breathe", "sphinx_copybutton", "extension"]
root_doc = "index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}

myst_enable_extensions = ["dollarmath"]
myst_dmath_allow_labels = False
myst_url_schemes = ("http", "https", "mailto", "equation")  # equation:ggx is of pages.py, and extension.py resolves it
myst_heading_anchors = 4
math_numfig = False
html_math_renderer = "katex"

# Every reference has to lead somewhere. What is not ours has no page here: the standard libraries, numpy.
nitpicky = True
nitpick_ignore_regex = [
    ("cpp:identifier", r"(std|uint\d+_t|int\d+_t|size_t)(::.*)?"),
    ("cpp:identifier", r"tofray|Impl"),
    ("py:class", r"Model"),   # of a Fit, which nobody makes by hand
]

breathe_projects = {"tofray": os.environ["TOFRAY_SITE_DOXYGEN"]}
breathe_default_project = "tofray"
breathe_show_include = False
breathe_default_members = ("members", "undoc-members")

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_preprocess_types = False
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = "tofray"
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
pygments_style = "friendly"
pygments_dark_style = "monokai"
copybutton_prompt_text = r">>> |\$ "
copybutton_prompt_is_regexp = True
