#!/usr/bin/env python3
"""Records what MuJoCo computes for the scenes of the environments on models of our own.

    pip install mujoco==3.12.0
    robohive assets own MODELS/hive
    python task_scenes.py --models MODELS --list LIST --out REFERENCES [--robohive PROGRAM]

A scene that several robots share names them by words (`ROBOT`), for which each environment gives its own. MuJoCo knows no such
words: the scene and the texts that it names are written again beside the originals, with the words replaced. LIST becomes
one path a line, relative to MODELS, of every scene of an environment whose id begins with `hive/`; REFERENCES gets an archive
of each, as `record.py` makes them.
"""

import argparse
import json
import re
import subprocess
from pathlib import Path

import mujoco
import numpy as np
from record import record

STATES = 10
STEPS = 300
NAMED = re.compile(r'(<(?:include|model)\b[^>]*?\bfile=")([^"]+)(")')


def arguments(doc):
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=Path, required=True, help="folder that holds `hive`, our models as files")
    parser.add_argument("--list", type=Path, required=True, help="file to write")
    parser.add_argument("--out", type=Path, required=True, help="folder for the archives")
    parser.add_argument("--robohive", default="robohive", help="the program")
    return parser.parse_args()


def asked(program, *words):
    """What the program says, as JSON."""
    return json.loads(subprocess.run([program, *words, "--json"], check=True, capture_output=True).stdout)


def scenes(program):
    """Every scene: its path, and the words that are replaced with their replacements."""
    ids = [entry["id"] for entry in asked(program, "list", "--only", "hive/")]
    settings = [asked(program, "info", name)["settings"] for name in ids]
    return {(each["model_path"], tuple(map(tuple, each.get("define", [])))) for each in settings}


def replaced(path, words, made):
    """The path of a file whose words are replaced, and those of the texts that it names; written if any is in them.
    `made` are the texts written so far."""
    text = original = path.read_text()
    for word, replacement in words:
        text = text.replace(word, replacement)

    def named(match):
        if not (path.parent / match[2]).exists():  # relative to the file that names this one: a part of a robot, without words
            return match[0]
        return match[1] + str(Path(match[2]).with_name(replaced(path.parent / match[2], words, made).name)) + match[3]

    text = NAMED.sub(named, text)
    if text == original:
        return path
    for count in range(1, len(words) + 1):
        suffix = re.sub(r"\W+", "_", "_".join(replacement for _, replacement in words[:count]))
        written = path.with_name(f"{path.stem}_{suffix}.xml")
        # Environments whose first words are the same may differ in others.
        if made.setdefault(written, text) == text:
            written.write_text(text)
            return written
    raise ValueError(f"{path}: two environments replace other words of it by the same")


def main():
    args = arguments(__doc__)
    # Of a relative path MuJoCo looks for texts that a model to be attached names below that path twice.
    args.models = args.models.resolve()
    found, made = [], {}
    for path, words in sorted(scenes(args.robohive)):
        found.append(replaced(args.models / path, words, made) if words else args.models / path)
    lines = sorted({str(path.relative_to(args.models)) for path in found})
    args.list.write_text("".join(line + "\n" for line in lines))
    args.out.mkdir(parents=True, exist_ok=True)
    for line in lines:
        model = mujoco.MjModel.from_xml_path(str(args.models / line))
        archive = args.out / (line.removesuffix(".xml").replace("/", "__") + ".npz")
        np.savez_compressed(archive, **record(model, states=STATES, steps=STEPS))
        print("recorded", line, flush=True)


if __name__ == "__main__":
    main()
