"""An engine for the tests of the host: it answers right, and misbehaves as its first argument says.

It answers spheres by exact integers; questions whose contact distance is 13 are where "... at 13" modes misbehave.
"""
import json
import os
import signal
import sys
import time

mode = sys.argv[1]
out = sys.stdout.buffer


def say(text):
    out.write(text.encode() if isinstance(text, str) else text)
    out.flush()


def hello(**changes):
    message = {"op": "hello", "protocol": 1, "engine": {"name": "misbehaving", "version": mode}, "scalar": "binary64",
               "pairs": ["sphere_sphere"], "claims": ["overlap"]}
    message.update(changes)
    say(json.dumps(message) + "\n")


def right(query):
    a, b = query["a"], query["b"]
    distance2 = sum((x - y) ** 2 for x, y in zip(a["center"], b["center"]))
    return {"op": "answer", "seq": query["seq"],
            "overlap": distance2 <= (a["radius"] + b["radius"] + query["alarm"]) ** 2}


def hang():
    while True:
        time.sleep(60)


if mode == "exits at once":
    sys.exit(7)
if mode == "says nothing":
    hang()
if mode == "is killed at once":
    os.kill(os.getpid(), signal.SIGSEGV)
if mode == "closes its output":
    os.close(1)
    hang()

held = []
for line in sys.stdin.buffer:
    message = json.loads(line)
    if message["op"] == "stop":
        break
    if message["op"] == "hello":
        if mode == "garbage hello":
            say("Welcome to my engine 1.0!\n")
        elif mode == "wrong protocol":
            hello(protocol=2)
        elif mode == "unknown pair":
            hello(pairs=["sphere_torus"])
        elif mode == "half a hello":
            say('{"op":"hello","pro')
            hang()
        else:
            hello()
        continue
    answer = right(message)
    smoke = message["seq"] == 1
    bad = message["contact"] == 13
    if mode == "claims nothing":
        del answer["overlap"]
    elif mode == "malformed smoke":
        answer["overlap"] = "yes"
    elif smoke:
        pass  # well behaved until the questions begin
    elif mode == "malformed at 13" and bad:
        answer["overlap"] = 1
    elif mode == "exits at 13" and bad:
        print("out of cheese", file=sys.stderr)
        sys.exit(3)
    elif mode == "is killed at 13" and bad:
        os.kill(os.getpid(), signal.SIGABRT)
    elif mode == "hangs at 13" and bad:
        hang()
    elif mode == "garbage at 13" and bad:
        say("*** internal error ***\n")
    elif mode == "invalid UTF-8 at 13" and bad:
        say(b'{"op":"answer","seq":%d,"error":"\xff\xfe"}\n' % message["seq"])
        continue
    elif mode == "half a line at 13" and bad:
        say('{"op":"answer","se')
        hang()
    elif mode == "half a line, then exits at 13" and bad:
        say('{"op":"answer","se')
        sys.exit(0)
    elif mode == "endless line at 13" and bad:
        while True:
            say(b"x" * 65536)
    elif mode == "floods at 13" and bad:
        while True:
            say(json.dumps(answer) + "\n")
    elif mode == "wrong seq at 13" and bad:
        answer["seq"] += 1000000
    elif mode == "repeats at 13" and bad or mode == "repeats everything":
        say(json.dumps(answer) + "\n")
    elif mode == "stops reading at 13" and bad:
        hang()
    elif mode == "exits from 1 on" and message["contact"] == 1:
        sys.exit(4)
    elif mode == "always exits":
        sys.exit(4)
    elif mode == "always hangs":
        hang()
    elif mode == "noisy":
        print("debug: " + "x" * 2000, file=sys.stderr)
    elif mode == "leaves a grandchild" and bad:
        if os.fork() == 0:
            hang()
    elif mode == "backwards":  # answers in the reverse order, four at a time
        held.append(answer)
        if len(held) == 4:
            for one in reversed(held):
                say(json.dumps(one) + "\n")
            held.clear()
        continue
    say(json.dumps(answer) + "\n")
