#include "sazare/runs/curves_hash.hpp"

#include "sazare/observe/hash.hpp"

namespace sazare::runs {

std::string curves_hash(std::span<cases::SoilBackbone* const> soils) {
  observe::Hash hash;
  bool any = false;
  for (cases::SoilBackbone* soil : soils) {
    if (soil->modulus_reduction.empty()) continue;
    any = true;
    soil->modulus_reduction = soil->modulus_reduction.filename();
    for (const auto* column : {&soil->reduction.strain, &soil->reduction.ratio}) hash.add(std::as_bytes(std::span(*column)));
  }
  return any ? observe::to_hex(hash.value()) : "";
}

}  // namespace sazare::runs
