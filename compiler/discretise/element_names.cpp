#include "discretise/element_names.hpp"

#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

std::string name_of(const std::vector<std::size_t>& elements, const Network& network) {
  std::string name;
  if (elements.size() <= 4)
    for (std::size_t element : elements) name = joined(name, network.elements[element].name);
  if (!name.empty() && name.size() <= 40) return name;
  const std::string& first = network.elements[elements.front()].name;
  return joined(joined(first, "to"), network.elements[elements.back()].name);
}

}  // namespace dashpot::compiler
