// dashpot-check HEADER CERTIFICATE: 0 if what the certificate states is proved, 1 if it is not true of this header or
// cannot be proved with what is there, 2 for a wrong command line, 3 if nothing is known of such a law here.
#include <fstream>
#include <iostream>
#include <iterator>

#include "check.hpp"

int main(int count, char** words) {
  if (count != 3) return std::cerr << "dashpot-check HEADER CERTIFICATE\n", 2;
  std::string texts[2];
  for (int i : {0, 1}) {
    std::ifstream file(words[i + 1]);
    texts[i].assign(std::istreambuf_iterator<char>(file), {});
    if (!file) return std::cerr << "dashpot-check: cannot read " << words[i + 1] << "\n", 2;
  }
  if (texts[0].starts_with('{')) std::swap(texts[0], texts[1]);  // the certificate came first
  const dashpot_check::Verdict verdict = dashpot_check::verdict(texts[0], texts[1]);
  std::cout << verdict.words;
  return verdict.proved ? 0 : verdict.is_known ? 1 : 3;
}
