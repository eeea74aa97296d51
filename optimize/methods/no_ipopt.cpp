// Stands in for ipopt_search.cpp in a build without Ipopt.

#include "strainwave/optimize/methods/ipopt_search.hpp"

#include <stdexcept>

namespace strainwave {

bool ipopt_available() {
  return false;
}

SearchResult search_ipopt(const Problem&, std::span<const double>, const SearchSettings&, Monitor&) {
  throw std::logic_error("this build has no Ipopt");
}

} // namespace strainwave
