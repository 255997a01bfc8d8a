"""Records small oracles of torch, torchvision, timm and Pillow for the tests of the encoders.

    python validation/reference/encoders/oracles.py src/encoders/tests/files

Writes `oracle.json`: features of networks of a few channels, whose weights and input follow from `number`; digests of Pillow's
resized bytes; prepared pictures at a few places. And files of few tensors as `torch.save` and safetensors write them.
"""

import collections
import json
import os
import pathlib
import sys

import numpy as np
import torch
import torchvision
from record import transform
from PIL import Image
from safetensors.torch import save_file
from timm.models.vision_transformer import VisionTransformer
from torchvision.models.resnet import BasicBlock, Bottleneck, ResNet

# The input of a network is counted as a tensor of its own.
INPUT = 1_000_000
PLACES = 40


def number(tensor, count):
    """Numbers from -1 to 1 that depend on the tensor and their place in it."""
    with np.errstate(over="ignore"):
        x = np.arange(count, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
        x += np.uint64(tensor + 1) * np.uint64(0xD1342543DE82EF95)
        x = (x ^ (x >> np.uint64(32))) * np.uint64(0xD6E8FEB86659FD93)
    return (x >> np.uint64(40)).astype(np.float32) / np.float32(1 << 23) - np.float32(1)


def fill(net, layout):
    """Sets the tensors of `layout`, and returns it with the offset and scale of each."""
    state = net.state_dict()
    rows = []
    for k, name in enumerate(layout):
        shape = list(state[name].shape)
        flat = len(shape) == 1
        positive = flat and name.endswith(("weight", "running_var"))
        offset = 1.0 if positive else 0.0
        scale = 0.5 if positive else 0.25 if flat else 2.0 / float(np.sqrt(np.prod(shape[1:])))
        values = np.float32(offset) + np.float32(scale) * number(k, int(np.prod(shape)))
        state[name].copy_(torch.from_numpy(values).reshape(shape))
        rows.append({"name": name, "shape": shape, "offset": offset, "scale": float(np.float32(scale))})
    return rows


def tiny_resnet(block, counts, width):
    """A ResNet of torchvision with fewer channels."""
    net = ResNet(block, counts)
    net.inplanes = width
    net.conv1 = torch.nn.Conv2d(3, width, 7, 2, 3, bias=False)
    net.bn1 = torch.nn.BatchNorm2d(width)
    for k, count in enumerate(counts):
        stage = net._make_layer(block, width << k, count, stride=1 if k == 0 else 2)
        setattr(net, f"layer{k + 1}", stage)
    net.fc = torch.nn.Identity()
    return net.eval()


def whole_resnet():
    net = torchvision.models.resnet18()
    net.fc = torch.nn.Identity()
    return net.eval()


def network(kind, net, side, sizes):
    layout = [name for name in net.state_dict() if not name.endswith("num_batches_tracked")]
    with torch.no_grad():
        rows = fill(net, layout)
        picture = torch.from_numpy(number(INPUT, 3 * side * side)).reshape(1, 3, side, side)
        features = net(picture).reshape(-1).tolist()
    return {"kind": kind, "side": side, "sizes": sizes, "tensors": rows, "features": features}


def networks():
    """sizes: blocks and width; or patch, width, depth and heads."""
    vit = {"img_size": 24, "patch_size": 8, "embed_dim": 12, "depth": 2, "num_heads": 3, "num_classes": 0}
    return [
        network("basic", tiny_resnet(BasicBlock, [1, 2, 1, 1], 4), 64, [1, 2, 1, 1, 4]),
        network("bottleneck", tiny_resnet(Bottleneck, [1, 1, 2, 1], 4), 45, [1, 1, 2, 1, 4]),
        network("basic", whole_resnet(), 224, [2, 2, 2, 2, 64]),
        network("transformer", VisionTransformer(**vit).eval(), 24, [8, 12, 2, 3]),
    ]


def picture(height, width):
    bits = ((number(height * 10_000 + width, height * width * 3) + 1) * 128).astype(np.uint8)
    return bits.reshape(height, width, 3)


def digest(array):
    """FNV-1a of 64 bits."""
    value = 0xCBF29CE484222325
    for byte in array.tobytes():
        value = (value ^ byte) * 0x100000001B3 % (1 << 64)
    return f"{value:016x}"


def resized():
    filters = {"bilinear": Image.BILINEAR, "bicubic": Image.BICUBIC}
    sizes = [((7, 5), (9, 11)), ((40, 60), (256, 384)), ((300, 200), (31, 57)), ((64, 48), (64, 20)), ((1, 9), (1, 4))]
    for (height, width), (rows, columns) in sizes:
        for name, kind in filters.items():
            out = np.asarray(Image.fromarray(picture(height, width)).resize((columns, rows), kind))
            yield {"filter": name, "input": [height, width], "output": [rows, columns], "digest": digest(out)}


def prepared():
    for name in ("r3m18", "rrl18", "vc1s"):
        for profile in ("fixed", "robohive"):
            for height, width in ((224, 224), (90, 120), (300, 257)):
                values = transform(name, profile, height, width)(picture(height, width)).reshape(-1)
                places = [(k * 7919 * 31 + 5) % len(values) for k in range(PLACES)]
                numbers = [float(values[place]) for place in places]
                size = [height, width]
                yield {"encoder": name, "profile": profile, "size": size, "places": places, "values": numbers}


class Command:
    """What a hostile pickle would have executed."""

    def __reduce__(self):
        return os.system, ("false",)


def files(folder):
    base = torch.arange(24, dtype=torch.float32).reshape(4, 6) / 8
    state = collections.OrderedDict(
        float=base,
        transposed=base.t(),
        part=base[1:3, 2:5],
        half=base.half(),
        brain=base.bfloat16(),
        double=base.double(),
        parameter=torch.nn.Parameter(base[0].clone()),
        count=torch.tensor(7),
        empty=torch.zeros(0, 3),
        scalar=torch.tensor(2.5),
    )
    torch.save(state, folder / "tensors.pt")
    torch.save(state, folder / "legacy.pt", _use_new_zipfile_serialization=False)
    contiguous = {name: value.detach().clone().contiguous() for name, value in state.items()}
    save_file(contiguous, folder / "tensors.safetensors", metadata={"format": "pt"})
    torch.save({"model": state, "optimizer": {"state": Command()}}, folder / "checkpoint.pt")
    torch.save({"float": base, "bad": Command()}, folder / "hostile.pt")
    torch.save({"float": torch.tensor([1.0, float("nan")])}, folder / "not_finite.pt")
    torch.save({"quantised": torch.quantize_per_tensor(base, 0.1, 0, torch.qint8)}, folder / "quantised.pt")


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    oracle = {"networks": networks(), "resized": list(resized()), "prepared": list(prepared())}
    text = json.dumps(oracle, indent=None).replace('{"kind"', '\n{"kind"').replace('{"filter"', '\n{"filter"')
    (folder / "oracle.json").write_text(text.replace('{"encoder"', '\n{"encoder"') + "\n")
    files(folder)


if __name__ == "__main__":
    main()
