"""What a person sets once: colours, glyphs, keys, layouts; files in the user's own folder."""
