// dashpot-check HEADER CERTIFICATE: 0 if what the certificate states is proved, 1 if not, 2 for a wrong command line.
#include <fstream>
#include <iostream>
#include <iterator>

#include "check.hpp"

int main(int count, char** words) {
  if (count != 3) return std::cerr << "dashpot-check HEADER CERTIFICATE\n", 2;
  std::ifstream header(words[1]), certificate(words[2]);
  const std::string text(std::istreambuf_iterator<char>(header), {});
  const auto verdict = dashpot_check::verdict(text, nlohmann::json::parse(certificate, nullptr, false));
  std::cout << verdict.words;
  return verdict.proved ? 0 : 1;
}
