#!/bin/sh
# count_instructions.sh BUILD_FOLDER: instructions a step of the Fig. 5 and Fig. 10 laws, by callgrind. Counted as the difference of two
# runs, so that start-up and the loop's ends drop out; five instructions are the loop and the feedback of the chain.
set -eu
steps=${1:?build folder}/tests/benchmarks/steps
counted() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$steps" "$1" "$2" 2>&1 | sed -n 's/.*Collected : //p'
}
for law in exact euler printed slip printed_slip; do
  few=$(counted "$law" 1000)
  many=$(counted "$law" 11000)
  echo "$law $(((many - few) / 10000)) instructions a step"
done
