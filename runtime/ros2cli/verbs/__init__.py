"""The commands, one file each; long verbs have their own."""
