#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "PhantomAnatomy.h"
#include "petrous/Phantom/Phantom.h"

namespace petrous::phantom
{

/// The phantom's layers of paint and how a point looks through them.
struct Phantom::Scene
{
  std::vector<anatomy::Layer> layers;
  std::vector<std::size_t> layerOf;               ///< structure -> its layer
  std::vector<std::vector<std::size_t>> coverers; ///< structure -> later layers that may meet it
  shapes::Shape cranial;

  static constexpr double kFar = 1e3; ///< mm; farther than any neighbourhood is wide

  /// Layers that decide the tissue within `reach` mm of a point, topmost first. `base` lies under
  /// all of them and covers the whole neighbourhood; -1 when that is the air round the head.
  struct Stack
  {
    std::vector<std::size_t> layers;
    int base = -1;
  };
  /// `among`: the stack of a neighbourhood that holds this one, to look at fewer layers.
  Stack stackAround(const shapes::Point& center, double reach, const Stack* among = nullptr) const;

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

  /// The layer's intensity at a point: marrow spaces of about a millimetre make bone mottled.
  static double intensityAt(const anatomy::Layer& layer, Modality modality, const shapes::Point& p)
  {
    const double value = intensity(layer, modality);
    return layer.mottle > 0.0 ? value * (1.0 + layer.mottle * shapes::mottling(p)) : value;
  }

  /// Whether every point that the stack leaves to its base looks the same.
  bool baseIsUniform(const Stack& stack) const
  {
    return stack.base < 0 || layers[static_cast<std::size_t>(stack.base)].mottle <= 0.0;
  }

  /// What a plane border's signed distance leaves of a voxel of `width` mm whose sensitivity falls
  /// linearly to 0 at its neighbours' centres. A box of one voxel instead would leave edges in what
  /// is sampled, and with them steps on every surface.
  static double coverage(double distance, double width)
  {
    const double t = std::clamp(distance / width, -1.0, 1.0);
    const double tail = 0.5 * (1.0 - std::abs(t)) * (1.0 - std::abs(t));
    return t < 0.0 ? 1.0 - tail : tail;
  }

  /// Each layer covers the share of a voxel of `width` mm that its signed distance gives.
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

  /// The topmost layer at a point, -1 for air round the head.
  int topmost(const shapes::Point& p, const Stack& stack) const
  {
    for (const std::size_t l : stack.layers)
      if (layers[l].shape(p) <= 0.0)
        return static_cast<int>(l);
    return stack.base;
  }

  double distance(std::size_t structure, const shapes::Point& p) const;

  /// The same inside a neighbourhood; far (of either sign) where it has no border of the layer.
  double distance(const Stack& stack, std::size_t layer, const shapes::Point& p) const
  {
    double d = -kFar;
    for (const std::size_t l : stack.layers)
    {
      if (l < layer)
        return kFar; // the layer is not among them
      if (l == layer)
        return std::max(d, layers[l].shape(p));
      d = std::max(d, -layers[l].shape(p));
    }
    return stack.base == static_cast<int>(layer) ? d : kFar;
  }
};

} // namespace petrous::phantom
