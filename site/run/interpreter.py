"""Runs blocks of Python that come as lines of JSON, one after the other with the same names, and answers in JSON."""

import contextlib
import faulthandler
import importlib.util
import io
import json
import os
import sys
import traceback

LIMIT = 120
"""Longest time of a block [s]."""

# What blocks print, in C too, must not end up among the answers.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
names = {"__name__": "__main__"}
for line in sys.stdin:
    block = json.loads(line)
    if any(importlib.util.find_spec(name) is None for name in block["needs"]):
        print(json.dumps({"lacking": True}), file=answers, flush=True)
        continue
    printed, well = io.StringIO(), True
    faulthandler.dump_traceback_later(LIMIT, exit=True)
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            exec(compile(block["code"], block["place"], "exec"), names)
    except BaseException:
        well = False
        printed.write(traceback.format_exc())
    faulthandler.cancel_dump_traceback_later()
    print(json.dumps({"well": well, "printed": printed.getvalue()}), file=answers, flush=True)
