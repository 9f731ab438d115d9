"""How many examples a test asks: a part every day, and with CONTACT_EVERY_EXAMPLE, as ./run python and ./run campaign set it, all."""
import os

EVERY = "CONTACT_EVERY_EXAMPLE" in os.environ


def some(names):
    """Every third of them, of a list of such as are alike."""
    return list(names) if EVERY else list(names)[::3]


def of(examples):
    return examples if EVERY else -(-examples // 10)
