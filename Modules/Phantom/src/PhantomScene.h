#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "PhantomAnatomy.h"
#include "petrous/Phantom/Phantom.h"

namespace petrous::phantom
{

/// The phantom's layers, and the evaluation of a point in them.
struct Phantom::Scene
{
  std::vector<anatomy::Layer> layers;
  std::vector<std::size_t> layerOf;               ///< structure -> its layer
  std::vector<std::vector<std::size_t>> coverers; ///< structure -> later layers that may cover it
  shapes::Shape cranial;

  static constexpr double kFar = 1e3; ///< mm; larger than any neighbourhood

  /// Layers that decide the tissue within `reach` mm of a point, topmost first. `base` is below all
  /// of them and covers the whole neighbourhood; -1 if that is the air around the head.
  struct Stack
  {
    std::vector<std::size_t> layers;
    int base = -1;
  };
  /// `among`: the stack of an enclosing neighbourhood, to test fewer layers. Where only the layers
  /// from `lowest` upwards matter, those below are left out, and `base` is -1 where none covers
  /// all.
  Stack stackAround(const shapes::Point& center, double reach, const Stack* among = nullptr,
                    std::size_t lowest = 0) const;

  static double intensity(const anatomy::Layer& layer, Modality modality)
  {
    return modality == Modality::Ct ? layer.ct : layer.mr;
  }
  double baseIntensity(const Stack& stack, Modality modality) const
  {
    if (stack.base < 0)
      return modality == Modality::Ct ? -1000.0 : 4.0;
    return intensity(layers[static_cast<std::size_t>(stack.base)], modality);
  }

  /// The layer's intensity at a point: marrow spaces of about a millimetre modulate bone.
  static double intensityAt(const anatomy::Layer& layer, Modality modality, const shapes::Point& p)
  {
    const double value = intensity(layer, modality);
    return layer.mottle > 0.0 ? value * (1.0 + layer.mottle * shapes::mottling(p)) : value;
  }

  /// Whether the intensity is constant wherever the stack's base is visible.
  bool baseIsUniform(const Stack& stack) const
  {
    return stack.base < 0 || layers[static_cast<std::size_t>(stack.base)].mottle <= 0.0;
  }

  /// Coverage of a voxel of `width` mm by a plane border at a signed distance, for a sensitivity
  /// that falls linearly to 0 at the neighbouring voxel centres. A box of one voxel would leave
  /// edges in the samples, and with them steps on every surface.
  static double coverage(double distance, double width)
  {
    const double t = std::clamp(distance / width, -1.0, 1.0);
    const double tail = 0.5 * (1.0 - std::abs(t)) * (1.0 - std::abs(t));
    return t < 0.0 ? 1.0 - tail : tail;
  }

  /// Composites the layers, each with the coverage of a voxel of `width` mm.
  double look(const shapes::Point& p, double width, Modality modality, const Stack& stack) const
  {
    double value = 0.0;
    double left = 1.0;
    for (const std::size_t l : stack.layers)
    {
      const double d = layers[l].shape(p);
      const double share = width > 0.0 ? coverage(d, width) : (d <= 0.0 ? 1.0 : 0.0);
      if (share > 0.0)
        value += left * share * intensityAt(layers[l], modality, p);
      left *= 1.0 - share;
      if (left <= 0.0)
        return value;
    }
    if (baseIsUniform(stack))
      return value + left * baseIntensity(stack, modality);
    return value + left * intensityAt(layers[static_cast<std::size_t>(stack.base)], modality, p);
  }

  /// The topmost layer at a point, -1 for the air around the head.
  int topmost(const shapes::Point& p, const Stack& stack) const
  {
    for (const std::size_t l : stack.layers)
      if (layers[l].shape(p) <= 0.0)
        return static_cast<int>(l);
    return stack.base;
  }

  double distance(std::size_t structure, const shapes::Point& p) const;

  /// The same within a neighbourhood; +-kFar if the layer has no border in it. A distance of
  /// `enough` or more may be too small.
  double distance(const Stack& stack, std::size_t layer, const shapes::Point& p,
                  double enough = kFar) const
  {
    double d = -kFar;
    for (const std::size_t l : stack.layers)
    {
      if (d >= enough)
        return d;
      if (l < layer)
        return kFar; // the layer is not in the stack
      if (l == layer)
        return std::max(d, layers[l].shape(p));
      d = std::max(d, -layers[l].shape(p));
    }
    return stack.base == static_cast<int>(layer) ? d : kFar;
  }
};

} // namespace petrous::phantom
