"""The least time in which a step can be done on a machine, from what its instructions cost (machine.cpp measures that).

A chain: the harness feeds a force into the next sample, by a fused multiplication (or multiply + add), then
  linear networks  m = (S + k0 u) + G v: with fused multiplications one of the two inputs passes both: 2 fused; without
                   them a product and two sums: multiply + 2 add;
  Fig. 10          t = F + K (u - u'), clamped from both sides: add + fused (or add + multiply + add), then 2 least.
Many branches: each has to load its force, its decay and its gain and to store its force, so a step lasts as long as the
loads or as the stores, whichever are longer, when nothing else does.
"""

WIDTH = {"sse2": 2, "avx2": 4, "avx512": 8}  # doubles a vector


def after_inputs(network, machine):
    fused = machine.get("fused")
    if network.startswith("fig_10"):
        return machine["add"] + (fused or machine["multiply"] + machine["add"]) + 2 * machine["least"]
    return 2 * fused if fused else machine["multiply"] + 2 * machine["add"]


def harness(machine):
    return machine.get("fused") or machine["multiply"] + machine["add"]


def states_alone(network, machine, target):
    if not network.startswith("maxwell"):
        return 0
    vectors = int(network.split("_")[1]) / WIDTH[target]
    return max(3 * vectors * machine["load"], vectors * machine["store"])


def chain(network, machine, target):
    return max(harness(machine) + after_inputs(network, machine), states_alone(network, machine, target))
