"""What is said of names that the program has put on the discs and a person has not confirmed."""

from __future__ import annotations

from dataclasses import dataclass

from carpus.core.words import marker_in_words
from carpus.ui.icons import State
from carpus.ui.marker_words import click_instruction, marker_name
from carpus.ui.markers.clicking import Clicking
from carpus.ui.translate import say, tr

MOST_NAMED = 4
"""So many doubtful or missing markers are named one by one."""


@dataclass(frozen=True, slots=True)
class ProposalWords:
    """State and line above the title, title, what to do, face of the primary button."""

    state: State
    step: str
    title: str
    place: str
    primary: str


def words_for(clicking: Clicking) -> ProposalWords:
    """Which names need a look, and what Enter does."""
    asked, open_names, doubtful = len(clicking.order), clicking.unnamed, clicking.doubtful
    named = len(clicking.proposed)
    primary = tr("Names are right") if not open_names else tr("Take {count} names").format(count=named)
    if not open_names and not doubtful:
        whole = tr("All {count} markers found").format(count=asked)
        todo = tr("Drag a name to another disc to change it.")
        if clicking.protocol.has_fingers:
            todo = tr("Each finger’s line runs from the wrist to its tip. Drag a name to another disc to change it.")
        return ProposalWords("good", whole, tr("Are these names right?"), todo, primary)
    if doubtful:
        step = (
            tr("1 name is doubtful")
            if len(doubtful) == 1
            else tr("{count} names are doubtful").format(count=len(doubtful))
        )
        todo = tr("Look at: {markers}. Enter says yes; drag a name to another disc to change it.")
        title = tr("Is this the {marker}?").format(marker=marker_in_words(doubtful[0], say))
        return ProposalWords("warn", step, title, todo.format(markers=_list(doubtful)), tr("Yes, it is"))
    step = tr("{named} of {asked} markers found").format(named=asked - len(open_names), asked=asked)
    todo = tr("Not found: {markers}. Take the other names with Enter, then click these.")
    return ProposalWords(
        "warn", step, click_instruction(clicking.current), todo.format(markers=_list(open_names)), primary
    )


def _list(names: tuple[str, ...]) -> str:
    words = [marker_name(names[0]), *(marker_in_words(name, say) for name in names[1:])]
    if len(words) > MOST_NAMED:
        return tr("{markers} and {count} more").format(
            markers=", ".join(words[:MOST_NAMED]), count=len(words) - MOST_NAMED
        )
    return ", ".join(words)
