#!/usr/bin/env python3
"""The example engines and engines that misbehave, certified as a user would: python3 engines_test.py TOOL FOLDER."""
