"""The commands, one file each; long verbs have files of their own."""
