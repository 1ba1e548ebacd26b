"""The site: notebooks, Python's reference, theory, files and scenes, and the program's commands.

tools/site.sh lays all pages into one folder, and runs Sphinx there.
"""

import gonio

project = "gonio"
author = "the authors of gonio"
copyright = author  # noqa: A001
version = release = gonio.__version__

extensions = ["myst_nb", "numpydoc", "sphinx.ext.autodoc"]
exclude_patterns = ["_build", "**/.ipynb_checkpoints"]

html_theme = "furo"
html_title = f"gonio {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_theme_options = {"sidebar_hide_name": False}

nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 600
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3

autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False
# parameters as in the signature, each with words; every part in its place
numpydoc_validation_checks = {"GL07", "GL08", "PR01", "PR02", "PR03", "PR04", "PR10", "RT01", "SS01", "SS03"}
numpydoc_validation_exclude = {r"\.__init__$"}  # its parameters are told of the class
