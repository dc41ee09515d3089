"""Errors that end the command, told in one line with a remedy."""
import re


def one_line(text: str) -> str:
    """The text for a line of a table or of the terminal, which would obey control characters: each is a blank."""
    return re.sub(r"[\x00-\x1f\x7f-\x9f]", " ", text)


class CohortError(Exception):
    """Who is at fault is told by the exit status, which is that of `scantet`: 2 wrong use, 3 input, 5 output."""

    def __init__(self, message: str, remedy: str = "", status: int = 2) -> None:
        super().__init__(message)
        self.remedy = remedy
        self.status = status
