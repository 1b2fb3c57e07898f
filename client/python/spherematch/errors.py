# SPDX-License-Identifier: MIT
"""What can go wrong."""


class Error(Exception):
    """Every error that this package raises on purpose."""


class TransportError(Error):
    """No answer came: the server cannot be reached, or was too slow."""


class JobFailed(Error):
    """A preparation or a pair failed; `problem` is the reason as the server gives it."""

    def __init__(self, problem):
        super().__init__(problem.get('detail') or problem.get('code'))
        self.problem = problem


class ProblemError(Error):
    """The server refused the request. Branch on `code`; `problem` holds all of the answer (RFC 9457)."""

    def __init__(self, status, problem, retry_after=None):
        super().__init__(f"{problem.get('code', status)}: {problem.get('detail', 'no reason given')}")
        self.status = status
        self.problem = problem
        self.code = problem.get('code')
        self.retry_after = retry_after
