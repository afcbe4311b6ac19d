"""The middleware of stepped runs of several processes: all messages pass through the coordinator, in a fixed order.

`Session` is a process's part. Its operations go to the `Switchboard` in the coordinator, which delivers them to the
other processes. The operations of a process:

    ("token", key, exists)                              an entry of the graph
    ("subscribe", key, wanted), ("serve", key, served)  what to deliver to it
    ("history", key, subscription, count)               deliver the last messages that publishers have kept
    ("keep", publisher, key, count), ("forget", publisher)
    ("put", publisher, key, payload, attachment)
    ("query", number, key, payload, attachment), ("reply", process, number, payload, attachment)
    ("published", count)                                how many messages it has published, for the report

What the switchboard delivers to it:

    ("token", key, exists), ("sample", key, payload, attachment), ("kept", key, subscription, payload, attachment),
    ("query", process, number, key, payload, attachment), ("reply", number, payload, attachment)
"""
