"""Records what torch, torchvision and timm make of seeded pictures with the encoders of RoboHive, and has it compared.

    pip install torch torchvision timm safetensors
    python validation/reference/encoders/record.py FOLDER --compare target/release/examples/compare --write validation/results/encoders.md
    python validation/reference/encoders/record.py FOLDER --only vc1s

For each encoder a network with seeded random weights, its batch normalisation calibrated on noise, is written into FOLDER:
as `torch.save` writes the published checkpoint (`weights.pt`), in the form before PyTorch 1.6 (`legacy.pt`) and as
safetensors; with pictures of several sizes, their encodings in both profiles and torch's time on one
thread, the shortest of several (`expected.safetensors`). With --compare the program is run on FOLDER, and the weights are removed before the next encoder.

The code between a picture and its encoding is RoboHive's 0.7, `env_base.py`, R3M's `models_r3m.py` and VC-1's `vit.py`.
"""

import argparse
import collections
import pathlib
import subprocess
import time

import numpy as np
import timm
import torch
import torchvision
import torchvision.transforms as T
from PIL import Image
from safetensors.torch import save_file

SIZES = [(224, 224), (256, 256), (240, 320), (500, 375), (100, 84), (31, 64)]
MEAN, STD = [0.485, 0.456, 0.406], [0.229, 0.224, 0.225]
RESNETS = {"18": torchvision.models.resnet18, "34": torchvision.models.resnet34, "50": torchvision.models.resnet50}
VITS = {"vc1s": ("vit_base_patch16_224", 768), "vc1l": ("vit_large_patch16_224", 1024)}
NAMES = [family + depth for family in ("r3m", "rrl") for depth in RESNETS] + list(VITS)
# 1.2 GB, which are not written a third time.
LARGEST = "vc1l"
REPEATS = 9


def pictures():
    """Smooth colours with noise on them, so that resizing and both ends of the range matter."""
    rng = np.random.default_rng(11)
    out = []
    for height, width in SIZES:
        y, x = np.mgrid[0:height, 0:width]
        waves = [np.sin(x / 9 + y / (7 + 3 * c) + c) for c in range(3)]
        noise = rng.normal(0, 40, (height, width, 3))
        out.append(np.clip(128 + 110 * np.stack(waves, -1) + noise, 0, 255).astype(np.uint8))
    return out


def calibrated(net):
    """Random gains, shifts and statistics of the size that training leaves."""
    for module in net.modules():
        if isinstance(module, torch.nn.BatchNorm2d):
            torch.nn.init.uniform_(module.weight, 0.5, 1.5)
            torch.nn.init.normal_(module.bias, 0, 0.2)
            module.momentum = None
    net.train()
    with torch.no_grad():
        for _ in range(2):
            net(torch.randn(4, 3, 224, 224))
    return net.eval()


def build(name):
    """The network, its state dictionary, and the checkpoint that holds it as published."""
    torch.manual_seed(NAMES.index(name))
    if name in VITS:
        net = timm.create_model(VITS[name][0], pretrained=False, num_classes=0).eval()
        with torch.no_grad():
            for parameter in net.parameters():
                parameter.add_(0.05 * torch.randn_like(parameter) if parameter.ndim == 1 else 0)
            net.pos_embed.normal_(0, 0.3)
            net.cls_token.normal_(0, 0.3)
        state = dict(net.state_dict())
        extra = {"mask_token": torch.zeros(1, 1, 4), "decoder_blocks.0.norm1.weight": torch.ones(4)}
        return net, state, {"model": state | extra, "epoch": 182, "args": argparse.Namespace(lr=1e-3)}
    net = calibrated(RESNETS[name[3:]]())
    if name.startswith("rrl"):
        state = net.state_dict()
        return torch.nn.Sequential(*list(net.children())[:-1]).float().eval(), dict(state), state
    net.fc = torch.nn.Identity()
    state = collections.OrderedDict((f"module.convnet.{key}", value) for key, value in net.state_dict().items())
    saved = collections.OrderedDict(state)
    saved["module.lang_rew.pred.0.weight"] = torch.zeros(3, 4)
    return net, dict(state), {"r3m": saved, "global_step": 7}


def transform(name, profile, height, width):
    """What prepares a picture, height x width x 3 bytes."""
    middle = [] if (height, width) == (224, 224) else [Image.fromarray, T.Resize(256), T.CenterCrop(224)]
    normalize = T.Normalize(mean=MEAN, std=STD)
    if name in VITS and profile == "robohive":
        steps = T.Compose([T.Resize(256, interpolation=T.InterpolationMode.BICUBIC), T.CenterCrop(224), normalize])
        return lambda img: steps(torch.Tensor(img[None].transpose(0, 3, 1, 2)))
    if name in VITS:
        bicubic = T.Resize(256, interpolation=T.InterpolationMode.BICUBIC)
        steps = [Image.fromarray, bicubic, T.CenterCrop(224), T.ToTensor(), normalize]
    elif name.startswith("rrl"):
        gain = 255.0 if profile == "robohive" else 1.0
        steps = middle + [T.ToTensor(), normalize, lambda x: gain * x]
    else:
        steps = middle + [T.ToTensor(), lambda x: 255.0 * x, lambda x: x / 255.0, normalize]
    return lambda img: T.Compose(steps)(img).reshape(-1, 3, 224, 224)


def record(name, folder, repeats):
    net, state, checkpoint = build(name)
    torch.save(checkpoint, folder / "weights.pt")
    if name != LARGEST:
        torch.save(checkpoint, folder / "legacy.pt", _use_new_zipfile_serialization=False)
    save_file({key: value.contiguous() for key, value in state.items()}, folder / "weights.safetensors")
    out = {}
    with torch.no_grad():
        for k, picture in enumerate(pictures()):
            out[f"picture{k}"] = torch.from_numpy(picture)
            for profile in ("fixed", "robohive"):
                prepared = transform(name, profile, *picture.shape[:2])(picture)
                out[f"prepared.{profile}{k}"] = prepared.contiguous()
                out[f"encoded.{profile}{k}"] = net(prepared).reshape(-1).contiguous()
        times = []
        for _ in range(repeats):
            start = time.perf_counter()
            net(transform(name, "robohive", 224, 224)(pictures_224))
            times.append(time.perf_counter() - start)
    out["milliseconds"] = torch.tensor([1e3 * min(times)])
    save_file(out, folder / "expected.safetensors")


def replace(path, rows):
    begin, end = "<!-- table begins -->\n", "<!-- table ends -->"
    text = path.read_text()
    head, tail = text.split(begin)[0], text.split(end)[1]
    path.write_text(head + begin + "\n" + "\n".join(rows) + "\n\n" + end + tail)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--compare", help="program that compares a folder and prints a row of the table")
    parser.add_argument("--write", type=pathlib.Path, help="file whose table is replaced")
    parser.add_argument("--repeats", type=int, default=REPEATS, help="pictures timed")
    a = parser.parse_args()
    torch.set_num_threads(1)
    rows = []
    for name in (name for name in NAMES if a.only in name):
        folder = a.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        record(name, folder, a.repeats)
        if a.compare:
            command = [a.compare, str(folder), name, str(a.repeats)]
            printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip().split("\n")
            rows = rows or printed[:2]
            rows.append(printed[2])
            print(printed[2], flush=True)
            for file in folder.iterdir():
                file.unlink()
    if a.write:
        replace(a.write, rows)


pictures_224 = pictures()[0]

if __name__ == "__main__":
    main()
