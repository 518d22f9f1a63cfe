// dashpot-check HEADER CERTIFICATE ends with what verdict() returns, and with 2 for a wrong command line.
#include <fstream>
#include <iostream>

#include "check.hpp"
int main(int count, char** words) {
  std::string texts[2];
  for (int i : {0, 1})
    if (std::ifstream file(count == 3 ? words[i + 1] : ""); file) std::getline(file, texts[i], '\0');
    else return std::cerr << "dashpot-check HEADER CERTIFICATE: two files that can be read\n", 2;
  if (texts[0].starts_with('{')) std::swap(texts[0], texts[1]);  // the certificate came first
  const auto [status, said] = dashpot_check::verdict(texts[0], texts[1]);
  return std::cout << said, status;
}
