"""How Sphinx makes the site of the pages that build.py has laid out."""
import os
import re
import sys

BUILT = os.environ.get("CONTACT_PYTHON")  # the folder of the built package; without it the core is a mock
sys.path.insert(0, BUILT or os.environ["CONTACT_PYTHON_SOURCE"])

project = "contact-oracle"
copyright = "the contributors of contact-oracle, MIT licence"
version = release = os.environ["CONTACT_VERSION"]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]

html_theme = "furo"
html_title = f"contact-oracle {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "navigation_with_keys": True,
    # Debian's build of the theme lacks the colours of its dark mode.
    "dark_css_variables": {
        "color-foreground-primary": "#dadada", "color-foreground-secondary": "#a4a8ad", "color-foreground-muted": "#8a8f96",
        "color-foreground-border": "#6b6b6b", "color-background-primary": "#141517", "color-background-secondary": "#1b1d20",
        "color-background-hover": "#22262a", "color-background-hover--transparent": "#22262a00", "color-background-border": "#33373a",
        "color-background-item": "#454545", "color-brand-primary": "#4a9eff", "color-brand-content": "#5aa5f5",
        "color-problematic": "#f07070", "color-highlighted-background": "#0d3a66", "color-highlight-on-target": "#33330a",
        "color-api-keyword": "#a4a8ad", "color-admonition-background": "#191a1d", "color-card-background": "#191a1d",
    },
}
pygments_style = "default"
pygments_dark_style = "native"

myst_heading_anchors = 6
suppress_warnings = ["misc.highlighting_failure",  # JSON with an ellipsis in it
                     "myst.header"]                # a page that begins with a deeper heading

breathe_projects = {"contact": os.environ["CONTACT_DOXYGEN_XML"]}
breathe_default_project = "contact"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
if not BUILT:
    autodoc_mock_imports = ["contact_oracle._core"]


def own_anchors(app, docname, source):
    """<a id="x"></a> in a page is a target of links, as its headings are."""
    labels = app.env.get_domain("std").anonlabels
    for name in re.findall(r'<a id="([^"]+)"></a>', source[0]):
        labels[f"{app.env.doc2path(docname, base=False)}#{name}"] = (docname, name)


def columns_to_fields(app, what, name, what_is_documented, options, lines):
    """In the package's docstrings "level      what is required" explains a name, and what follows is indented: a list of fields."""
    in_field = False
    for index, line in enumerate(lines):
        # The longest name of a list may leave room for one space alone.
        entry = re.fullmatch(r" *(\w+(?:, \w+)*) {2,}(\S.*)", line) or in_field and re.fullmatch(r"(\w+) (\S.*)", line)
        in_field = bool(entry) or in_field and line.startswith(" ")
        if entry:
            lines[index] = f":{entry[1]}: {entry[2]}"
        elif in_field:
            lines[index] = "    " + line.strip()


def setup(app):
    app.connect("autodoc-process-docstring", columns_to_fields)
    app.connect("source-read", own_anchors)
