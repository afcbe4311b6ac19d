"""The filter grammar against a naive model, one record at a time; the log finds the same in blobs of many records."""

import pytest
from bot_console.tui.console.logs import patterns
from bot_console.tui.console.logs.search import matching
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.model import LogFilter, Severity
from hypothesis import given, settings
from hypothesis import strategies as st

LEVELS = [each for each in Severity if each is not Severity.UNSET]
WORDS = ["ab", "b", "AB", "ba", "zoo"]
TESTS = {
    "a.b": lambda text: any(
        line[i : i + 1] == "a" and line[i + 2 : i + 3] == "b" for line in text.split("\n") for i in range(8)
    ),
    "^a": lambda text: any(line.startswith("a") for line in text.split("\n")),
    "b$": lambda text: any(line.endswith("b") for line in text.split("\n")),
    r"a\sb": lambda text: "a b" in text or "a\nb" in text,
    "[^b]a": lambda text: any(text[i] != "b" and text[i + 1 : i + 2] == "a" for i in range(len(text))),
    r"b\W": lambda text: "b " in text or "b\n" in text,
}
NODES = ["arm.left.zoo", "/arm/left/zoo", "bat", "zoo-1"]
texts = st.text("ab \n", max_size=8).map(str.lower)
records = st.lists(st.tuples(st.sampled_from(LEVELS), st.sampled_from(NODES), texts), max_size=40)


def plain(word):
    return word, lambda level, node, text: word.lower() in text or dotted(word).strip(".") in dotted(node)


def dotted(name):
    return "." + name.lower().replace("/", ".").lstrip(".")


def node_word(part):
    return f"node:{part}", lambda level, node, text: part.replace("/", ".") in dotted(node)


def severity_word(sign, level):
    compare = {"": level.__eq__, ">=": level.__le__, "<": level.__gt__, "<=": level.__ge__, ">": level.__lt__}[sign]
    return f"sev:{sign}{level.name.lower()}", lambda found, node, text: compare(found)


def pattern(written):
    return f're:"{written}"', lambda level, node, text: TESTS[written](text)


word = st.one_of(
    st.sampled_from(WORDS).map(plain),
    st.sampled_from(["left.zoo", "left/zoo", "/arm", "bat"]).map(node_word),
    st.builds(severity_word, st.sampled_from(["", ">=", "<", "<=", ">"]), st.sampled_from(LEVELS)),
    st.sampled_from(sorted(TESTS)).map(pattern),
)


words_and_lines = given(records, st.lists(st.tuples(word, st.booleans()), max_size=4), st.integers(1, 4))


@settings(deadline=None, max_examples=200)
@words_and_lines
def test_the_log_finds_what_the_words_say(lines, words, times):
    the_log_finds(lines, words, times)


@settings(deadline=None, max_examples=50)
@words_and_lines
def test_it_finds_the_same_without_re2(lines, words, times):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(patterns, "re2", None)
        the_log_finds(lines, words, times)


def the_log_finds(lines, words, times):
    store = LogStore(2000)
    lines = lines * times * 3
    for level, node, text in lines:
        store.add(1, level, node, text)
    typed = " ".join(("!" if turned else "") + written for (written, _), turned in words)
    wanted = [
        number
        for number, line in enumerate(lines)
        if all(bool(holds(*line)) is not turned for (_, holds), turned in words)
    ]
    assert matching(store, LogFilter(words=typed)) == wanted
