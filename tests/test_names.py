"""Functions are verbs, nouns or questions (``is_``, ``has_``), classes are nouns, limits are ``min`` and ``max``.

What does not follow the rule yet is listed in ``names_to_change.txt``, one ``path name`` a line. The list only shrinks:
``python -m tests.test_names`` takes names off it that are gone, and adds none.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from tests.sources import ROOT, SOURCES, modules, nodes

pytestmark = SOURCES

LIST = Path(__file__).with_name("names_to_change.txt")


def words_in(text: str) -> set[str]:
    return set(text.split())


IRREGULAR = words_in(
    """
    told said shown seen known done made kept left found lost heard held begun drawn given taken chosen written
    gone met sent bent laid lain learnt stood grown thrown hidden worn driven risen fallen spoken forgotten
    brought thought meant built spent bound wound hung led fed sought caught taught torn broken frozen undone
    came went unseen untold unknown
    """
)
NO_PARTICIPLE = words_in(
    """
    need feed speed seed shed embed bed red exceed proceed indeed shred med led sped id
    """
)
FUNCTION_WORDS = words_in(
    """
    of at in on by for into within between beside before after above below under over behind around about along
    across through during since until beyond near inside outside against toward towards besides upon off out up
    down back away again now then still once ahead apart aside alone together only too also even yet not no
    never as when while where why what which who whose how if both each every all own other another same such
    more most less least first last next newest latest nearest best worst furthest fewest new old whole may can
    would could should must was were did does a an the this that these those there here
    """
)
IDIOMS = tuple(
    f"{word}_" for word in words_in("to from with is has on as without next last first new can all latest nearest")
)
"""A name of several words may begin with these: ``to_json``, ``with_clicks``, ``can_record``."""
THIRD_PERSON = words_in(
    """
    holds shows asks stays fits ends goes looks wants needs counts answers sees knows says tells keeps leads
    lies runs comes moves makes takes gives finds stops waits opens closes begins follows belongs covers matters
    speaks hears
    """
)
ODD_VERBS = words_in(
    """
    hear tell say ask look lay let furnish obey put take go give leave bring hold speak lead stand reach seek
    walk wait forget remember gather tidy settle doubt rest
    """
)
PREPOSITIONS = words_in(
    """
    of at in on by for to from with as against beside between over under within
    """
)
TERMS = {"zoom_in", "back_up_file", "leave_one_out_misfit"}
"""What Qt, disks and statistics call so."""
LEAST = {"least", "most", "fewest"}


def is_participle(word: str) -> bool:
    return (word.endswith("ed") and word not in NO_PARTICIPLE) or word in IRREGULAR


def is_plain_function(name: str) -> bool:
    bare = name.strip("_")
    words = bare.split("_")
    if words[0] in ("is", "has") or bare in TERMS:
        return True
    if is_participle(words[0]) and (len(words) == 1 or words[-1] in PREPOSITIONS or is_participle(words[-1])):
        return False  # "told", "said_of"; an adjective before its noun ("selected_day") is a noun phrase
    if len(words) > 1 and bare.startswith(IDIOMS):
        return True
    if words[0] in FUNCTION_WORDS | THIRD_PERSON | ODD_VERBS:
        return False
    return len(words) == 1 or words[-1] not in PREPOSITIONS


def is_plain_class(name: str) -> bool:
    bare = name.strip("_")
    words = "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in bare).split()
    return not (len(words) == 1 and is_participle(words[0])) and words[0] not in FUNCTION_WORDS | THIRD_PERSON


def names_that_are_not_plain() -> Iterator[str]:
    for path in modules("app", "core", "ui"):
        place = path.relative_to(ROOT).as_posix()
        for node in nodes(path):
            if isinstance(node, ast.FunctionDef):
                has_own_name = not node.name.startswith("__") and node.name.islower()  # Qt's overrides have capitals
                if has_own_name and not is_plain_function(node.name):
                    yield f"{place} {node.name}"
            elif isinstance(node, ast.ClassDef):
                if not is_plain_class(node.name):
                    yield f"{place} {node.name}"
            elif isinstance(node, (ast.Assign, ast.AnnAssign)):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                for target in targets:
                    is_constant = isinstance(target, ast.Name) and target.id.isupper()
                    if is_constant and LEAST & set(target.id.lower().split("_")):
                        yield f"{place} {target.id}"


def names_on_the_list() -> set[str]:
    return set(LIST.read_text(encoding="utf-8").splitlines())


def test_names_new_ones_are_plain() -> None:
    new = sorted(set(names_that_are_not_plain()) - names_on_the_list())
    assert new == [], "name a function by a verb and its object, a class by a noun, a limit by min or max"


def test_names_list_has_only_names_that_exist() -> None:
    gone = sorted(names_on_the_list() - set(names_that_are_not_plain()))
    assert gone == [], "python -m tests.test_names takes them off"


def test_names_rules_tell_plain_from_odd() -> None:
    plain = ("compute_gate", "is_seen", "gate_px", "to_json", "speed", "with_clicks", "has_depth", "session_saved")
    assert [name for name in plain if not is_plain_function(name)] == []
    odd = ("told", "of", "up", "said_of", "hears", "furnish", "widened", "name_of")
    assert [name for name in odd if is_plain_function(name)] == []
    assert is_plain_class("ModeMixture")
    assert not any(map(is_plain_class, ("Heard", "Behind", "Begun")))


if __name__ == "__main__":
    kept = sorted(names_on_the_list() & set(names_that_are_not_plain()))
    LIST.write_text("".join(f"{name}\n" for name in kept), encoding="utf-8")
