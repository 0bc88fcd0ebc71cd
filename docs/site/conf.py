# The documents as a site: Sphinx reads the Markdown as it lies in the repository (MyST). tools/docs calls it.
import os

project = "Brickfall"
author = "the authors of Brickfall"
version = release = os.environ.get("BRICKFALL_VERSION", "")
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
exclude_patterns = []
myst_heading_anchors = 4
# Headings may be skipped in pages that a test writes; highlighting of snippets is left to what Pygments knows.
suppress_warnings = ["myst.header", "misc.highlighting_failure"]
highlight_language = "none"
html_theme = "alabaster"
html_theme_options = {"fixed_sidebar": True, "page_width": "72rem", "sidebar_width": "17rem", "show_powered_by": False}
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_copy_source = False
html_show_sourcelink = False
html_extra_path = ["extra"]
