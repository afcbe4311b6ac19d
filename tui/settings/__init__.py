"""The user's settings: colours, glyphs, keys, layouts; files in the user's own folder."""
