#pragma once
// What a sequence of meshes says about a number: f(h) ≈ f₀ + C hᵖ with the size h of the elements.
//
//     (f₃ − f₂)/(f₂ − f₁) = (h₃ᵖ − h₂ᵖ)/(h₂ᵖ − h₁ᵖ)          h₃ > h₂ > h₁, f₁ on the finest mesh
//     f₀ = f₁ − (f₂ − f₁) h₁ᵖ/(h₂ᵖ − h₁ᵖ)                     Richardson's extrapolation
//
// Source: Celik et al., J. Fluids Eng. 130 (2008) 078001. Example: f = 1 + h² on h = 1, ½, ¼ has p = 2, f₀
// = 1. Numbers that swing or do not draw together have no order; neither have those that agree to rounding.

#include <optional>
#include <span>

namespace strainwave {

struct ObservedOrder {
  double order = 0.0;
  double limit = 0.0; ///< f₀
};

/// From the last three of `size` (falling) and `value`, as many; nothing where there is no order.
std::optional<ObservedOrder> observed_order(std::span<const double> size, std::span<const double> value);

} // namespace strainwave
