"""Stepped runs of several operating system processes: one of them coordinates, and owns the simulated time.

`coordinator.Coordinator` has a `member_process.MemberProcess` for each process of a user. The process itself has a
`member.Member`: it runs until all its threads wait, then it reports its earliest deadline and hands over what it has
published.
"""
