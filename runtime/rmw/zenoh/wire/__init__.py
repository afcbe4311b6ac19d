"""The wire format of rmw_zenoh: keys, tokens, QoS and attachments."""
