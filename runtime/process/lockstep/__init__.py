"""Stepped runs of several operating system processes: one of them coordinates, and owns the simulated time.

`coordinator.Coordinator` has a `member_process.MemberProcess` for each user process. The process itself has a
`member.Member`: it runs until all its threads wait, then reports its earliest deadline and passes on what it has
published.
"""
