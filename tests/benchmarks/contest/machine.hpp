// What this machine's instructions cost, measured beside the contenders: the numbers in limits.py's formulas.
#pragma once

namespace dashpot::contest {

// Benchmarks called machine/add, multiply, fused, least, compare: latencies; machine/load: time of one load of the
// target's width where nothing waits for it; machine/store: of one store.
void announce_machine();

}  // namespace dashpot::contest
