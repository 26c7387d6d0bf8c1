"""Modules that tests use where they are there."""


def has(module):
    try:
        __import__(module)
    except ImportError:
        return False
    return True
