"""Tests of certify that are not of its fresh questions leave them out: they differ from run to run, and take their time."""

# What asks questions of its own, or says itself which are asked.
SAYS = ("--fresh", "--seed", "--generate", "--failures-of", "--help")


def published(words):
    """The words of a command, with --fresh 0 where it is certify and does not say; what stands before is the program, or options of every command."""
    words = [str(word) for word in words]
    at = words.index("certify") if "certify" in words else len(words)
    if at == len(words) or any(not word.startswith("-") and "/" not in word and word != "always" for word in words[:at]):
        return words
    if any(word.split("=")[0] in SAYS for word in words):
        return words
    return [*words[:at + 1], "--fresh", "0", *words[at + 1:]]
