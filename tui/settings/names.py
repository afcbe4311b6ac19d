"""Names that a command line or the settings file may use; cheap to import, since every start reads them."""

THEME_NAMES = ("dark", "light", "high-contrast", "terminal")
GLYPHS = ("auto", "full", "plain")
