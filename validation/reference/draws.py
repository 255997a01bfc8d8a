"""Records numpy's draws: for every kind of draw and each of 20 seeds a digest of a million draws, and the first three.

    python validation/reference/draws.py --out validation/reference/draws.txt

Normal draws depend on the C library: record with glibc 2.28 to 2.40 on an x86-64 processor with fused multiply-add.
Each line: family.kind, number of draws, the first three of seed 0, then a digest for each seed. Draws are words of 64 bits:
the bits of a number, integers in two's complement. `validation/src/draws` makes the same draws and digests.
"""

import argparse
import platform

import numpy as np
from numpy.random import MT19937, PCG64, Generator, RandomState, SeedSequence

SEEDS = [*range(17), 1234567, 2**31, 2**32 - 1]
MILLION = 10**6
# Draws of kinds that call numpy once for each.
SINGLE = 20_000

STEP = np.uint64(0x9E3779B97F4A7C15)
MIX = np.uint64(0xD1342543DE82EF95)


def words(draws):
    draws = np.asarray(draws)
    if draws.dtype == np.float64:
        return draws.ravel().view(np.uint64)
    if draws.dtype == np.uint64:
        return draws.ravel()
    return draws.ravel().astype(np.int64).view(np.uint64)


def digest(draws):
    """Sum of w_k STEP^(n-1-k) over mixed words w, modulo 2^64."""
    w = draws ^ (draws >> np.uint64(32))
    w = w * MIX
    w = w ^ (w >> np.uint64(29))
    powers = np.full(len(w), STEP)
    powers[0] = 1
    return int(np.sum(w * np.multiply.accumulate(powers)[::-1]))


def weights(count):
    return np.arange(1.0, count + 1) / (count * (count + 1) / 2)


def repeat(times, draw):
    return np.concatenate([np.atleast_1d(draw()) for _ in range(times)])


LOW = np.linspace(-1.0, 0.0, 8)
HIGH = np.array([-1.0, 0.0, 1.0, 2.0, 3.0, 1e3, 1e-3, 5e300])

# Name, type, first, last.
RANGES = [
    ("single", np.int64, 5, 5),
    ("pair", np.int64, 0, 1),
    ("ten", np.int64, 0, 9),
    ("negative", np.int64, -7, 5),
    ("below_2_32", np.int64, 0, 2**32 - 2),
    ("at_2_32", np.int64, 0, 2**32 - 1),
    ("above_2_32", np.int64, 0, 2**32),
    ("many_rejections_32", np.int64, 0, 2**31),
    ("many_rejections_64", np.int64, -(2**62), 2**62),
    ("to_largest", np.int64, 0, 2**63 - 1),
    ("all_i64", np.int64, -(2**63), 2**63 - 1),
    ("at_2_63", np.uint64, 0, 2**63),
    ("all_u64", np.uint64, 0, 2**64 - 1),
    ("i32", np.int32, -1000, 999),
    ("all_i32", np.int32, -(2**31), 2**31 - 1),
    ("u32", np.uint32, 7, 3_000_000_000),
    ("i16", np.int16, -300, 299),
    ("all_u16", np.uint16, 0, 2**16 - 1),
    ("u8", np.uint8, 0, 199),
    ("many_rejections_8", np.uint8, 0, 128),
    ("all_i8", np.int8, -128, 127),
    ("bool", np.bool_, 0, 1),
]


def shuffled(random):
    items = np.arange(MILLION) * 3
    random.shuffle(items)
    return items


def mixed(g):
    """Draws of 32 and of 64 bits in turn."""
    for _ in range(SINGLE // 4):
        yield int(g.integers(0, 10)) % 2**64
        yield int(words(g.random())[0])
        yield int(g.integers(0, 200, dtype=np.uint8))
        yield int(words(g.standard_normal())[0])


def mixed_legacy(r):
    for _ in range(SINGLE // 4):
        yield int(r.randint(0, 10)) % 2**64
        yield int(words(r.random_sample())[0])
        yield int(r.randint(0, 200, dtype=np.uint8))
        yield int(words(r.standard_normal())[0])


def state_words(state):
    if state["bit_generator"] == "PCG64":
        inner = state["state"]
        halves = [inner[k] >> shift & (2**64 - 1) for k in ("state", "inc") for shift in (64, 0)]
        return [*halves, state["has_uint32"], state["uinteger"]]
    inner = [int(word) for word in state["state"]["key"]] + [state["state"]["pos"]]
    if "gauss" in state:
        inner += [state["has_gauss"], int(words(state["gauss"])[0])]
    return inner


def state_after_draws(g):
    g.integers(0, 10, size=1001)
    return np.array(state_words(g.bit_generator.state), np.uint64)


def legacy_state_after_draws(r):
    r.standard_normal(size=1001)
    return np.array(state_words(r.get_state(legacy=False)), np.uint64)


def integers_of(dtype, first, last):
    return lambda g: g.integers(first, last, size=MILLION, dtype=dtype, endpoint=True)


def randint_of(dtype, first, last):
    return lambda r: r.randint(first, last + 1, size=MILLION, dtype=dtype)


def generator_kinds():
    kinds = {
        "random": lambda g: g.random(MILLION),
        "uniform": lambda g: g.uniform(-1.5, 2.5, MILLION),
        "uniform_each": lambda g: g.uniform(LOW, HIGH, (MILLION // 8, 8)),
        "standard_normal": lambda g: g.standard_normal(MILLION),
        "normal": lambda g: g.normal(0.25, 3.0, MILLION),
    }
    kinds |= {f"integers_{name}": integers_of(*bounds) for name, *bounds in RANGES}
    kinds |= {
        "integer_single_u8": lambda g: repeat(SINGLE, lambda: g.integers(0, 200, dtype=np.uint8)),
        "mixed": lambda g: np.fromiter(mixed(g), np.uint64),
        "choice": lambda g: g.choice(1000, MILLION),
        "choice_one": lambda g: repeat(SINGLE, lambda: g.choice([0, 1, 2, 3, 4])),
        "choice_weighted": lambda g: g.choice(100, MILLION, p=weights(100)),
        "choice_part": lambda g: repeat(1000, lambda: g.choice(MILLION, 1000, replace=False)),
        "choice_part_unordered": lambda g: repeat(1000, lambda: g.choice(MILLION, 1000, replace=False, shuffle=False)),
        "choice_few": lambda g: repeat(SINGLE, lambda: g.choice(5, 3, replace=False)),
        "choice_half": lambda g: g.choice(2 * MILLION, MILLION, replace=False),
        "choice_half_unordered": lambda g: g.choice(2 * MILLION, MILLION, replace=False, shuffle=False),
        "choice_all": lambda g: g.choice(MILLION, MILLION, replace=False),
        "choice_at_limit": lambda g: repeat(100, lambda: g.choice(10_001, 200, replace=False)),
        "choice_above_limit": lambda g: repeat(100, lambda: g.choice(10_001, 201, replace=False)),
        "choice_weighted_part": lambda g: repeat(
            1000, lambda: g.choice(2000, 1000, replace=False, p=weights(2000))
        ),
        "shuffle": shuffled,
        "permutation": lambda g: g.permutation(MILLION),
        "state": state_after_draws,
    }
    return kinds


def legacy_kinds():
    kinds = {
        "random": lambda r: r.random_sample(MILLION),
        "uniform": lambda r: r.uniform(-1.5, 2.5, MILLION),
        "uniform_reversed": lambda r: r.uniform(2.5, -1.5, MILLION),
        "uniform_each": lambda r: r.uniform(LOW, HIGH, (MILLION // 8, 8)),
        "standard_normal": lambda r: r.standard_normal(MILLION),
        "normal": lambda r: r.normal(0.25, 3.0, MILLION),
    }
    kinds |= {f"randint_{name}": randint_of(*bounds) for name, *bounds in RANGES}
    kinds |= {
        "randint_single_u8": lambda r: repeat(SINGLE, lambda: r.randint(0, 200, dtype=np.uint8)),
        "mixed": lambda r: np.fromiter(mixed_legacy(r), np.uint64),
        "choice": lambda r: r.choice(1000, MILLION),
        "choice_one": lambda r: repeat(SINGLE, lambda: r.choice([0, 1, 2, 3, 4])),
        "choice_weighted": lambda r: r.choice(100, MILLION, p=weights(100)),
        "choice_few": lambda r: repeat(SINGLE, lambda: r.choice(5, 3, replace=False)),
        "choice_half": lambda r: r.choice(2 * MILLION, MILLION, replace=False),
        "choice_weighted_part": lambda r: repeat(
            1000, lambda: r.choice(2000, 1000, replace=False, p=weights(2000))
        ),
        "shuffle": shuffled,
        "permutation": lambda r: r.permutation(MILLION),
        "state": legacy_state_after_draws,
    }
    return kinds


def seed_sequences(seed):
    """States of seed sequences: small and large entropy, sequences of numbers, spawn keys, children's children."""
    child = SeedSequence(seed).spawn(3)[2]
    sequences = [
        SeedSequence(seed),
        SeedSequence(seed * 3**50),
        SeedSequence(seed + 10**300),
        SeedSequence([seed, 0, 2**40, 7, 2**63]),
        SeedSequence([]),
        SeedSequence(seed, spawn_key=(0,)),
        SeedSequence(seed * 3**50 + 2**130, spawn_key=(5, 2**33)),
        child,
        child.spawn(2)[1],
    ]
    return np.concatenate([s.generate_state(11) for s in sequences]).astype(np.uint64)


def families():
    rows = [(f"pcg64.{name}", lambda seed, kind=kind: kind(Generator(PCG64(seed)))) for name, kind in generator_kinds().items()]
    rows += [
        (f"mt19937.{name}", lambda seed, kind=kind: kind(Generator(MT19937(seed)))) for name, kind in generator_kinds().items()
    ]
    rows += [(f"legacy.{name}", lambda seed, kind=kind: kind(RandomState(seed))) for name, kind in legacy_kinds().items()]
    keys = {"short": 1, "long": 1000}
    for name, length in keys.items():
        make = lambda seed, n=length: RandomState([(seed + k * k) % 2**32 for k in range(n)]).random_sample(MILLION)
        rows.append((f"legacy_key_{name}.random", make))
    rows.append(("legacy_sequence_seeded.random", lambda seed: RandomState(MT19937(seed)).random_sample(MILLION)))
    rows.append(("seed_sequence.state", seed_sequences))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", required=True)
    out = parser.parse_args().out
    library = " ".join(platform.libc_ver())
    lines = [f"# numpy {np.__version__}, {library}, {platform.machine()}", "# seeds " + " ".join(map(str, SEEDS))]
    for name, draw in families():
        digests = []
        for seed in SEEDS:
            drawn = words(draw(seed))
            if seed == SEEDS[0]:
                first = ",".join(f"{int(word):x}" for word in drawn[:3])
            digests.append(f"{digest(drawn):016x}")
        lines.append(f"{name} {len(drawn)} {first} " + " ".join(digests))
        print(lines[-1][:80], flush=True)
    with open(out, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
