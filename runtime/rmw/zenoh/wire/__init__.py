"""What travels, as rmw_zenoh writes it: keys, tokens, qualities of service, attachments."""
