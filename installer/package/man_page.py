"""The manual page, from what the command line says of itself."""

from __future__ import annotations

from collections.abc import Mapping


def escaped(text: str) -> str:
    """Text as troff takes it."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join(f"\\&{line}" if line.startswith((".", "'")) else line for line in text.splitlines())


def man_page(version: str, date: str, commands: Mapping[str, str]) -> str:
    """``carpus(1)``; ``commands`` by name with one sentence each."""
    lines = [
        f'.TH CARPUS 1 "{date}" "Carpus {version}" "User Commands"',
        ".SH NAME",
        "carpus \\- measures how a wrist and a hand move, for hand rehabilitation",
        ".SH SYNOPSIS",
        ".B carpus",
        r"[\fICOMMAND\fR] [\fIOPTIONS\fR]",
        ".br",
        ".B carpus",
        r"\fISESSION\fR.h5",
        ".SH DESCRIPTION",
        escaped(
            "Without a command the desktop opens; with a session file it opens in the review. "
            "A depth camera looks down on a hand with blue paper discs on it; Carpus follows them and reports the "
            "angles of wrist and fingers with their standard deviations."
        ),
        ".SH COMMANDS",
        r"Each has its own \fB\-\-help\fR.",
    ]
    for name, words in commands.items():
        lines += [".TP", f"\\fB{escaped(name)}\\fR", escaped(words)]
    lines += [
        ".SH EXIT STATUS",
        escaped("0 done, 1 could not be done (one line says why), 2 wrong usage."),
        ".SH ENVIRONMENT",
        ".TP",
        r"\fBCARPUS_DATA\fR",
        "Folder of patients and sessions, over the settings.",
        ".SH NOTES",
        escaped("For research and education. Not a medical device."),
    ]
    return "\n".join(lines) + "\n"
