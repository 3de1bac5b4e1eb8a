#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <vector>

#include <tbb/parallel_for.h>

#include "PhantomScene.h"

namespace petrous::phantom
{
namespace
{

// As in Scene::stackAround: factors by which a distance may be wrong, outside and inside.
constexpr double kOutside = 1.3;
constexpr double kInside = 2.1;

double boxDistance(const shapes::Box& box, const shapes::Point& p)
{
  return std::max((box.min() - p).maxCoeff(), (p - box.max()).maxCoeff());
}

/// Volume of a layer in a cell: recursively split in eight down to the resolution.
double cellVolume(const Phantom::Scene& scene, std::size_t layer,
                  const Phantom::Scene::Stack* among, const shapes::Point& center,
                  const Eigen::Vector3d& edge, double resolution)
{
  const auto stack = scene.stackAround(center, 0.5 * edge.norm(), among);
  const double width = std::cbrt(edge.prod());
  const double d = scene.distance(stack, layer, center);
  if (d >= Phantom::Scene::kFar)
    return 0.0;
  if (stack.layers.empty())
    return edge.prod();
  if (width <= resolution)
    return edge.prod() * std::clamp(0.5 - d / width, 0.0, 1.0);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d side((corner & 1) ? 0.25 : -0.25, (corner & 2) ? 0.25 : -0.25,
                               (corner & 4) ? 0.25 : -0.25);
    sum +=
        cellVolume(scene, layer, &stack, center + edge.cwiseProduct(side), 0.5 * edge, resolution);
  }
  return sum;
}

/// Marching tetrahedra over a lattice of signed distances: closed by construction, since every
/// crossed edge gives one vertex and every crossed face one segment.
class Polygoniser
{
public:
  template <class Distance>
  Polygoniser(const shapes::Box& box, double step, const Distance& distance)
    : m_origin(box.min().array() - 1.5 * step)
    , m_step(step)
  {
    for (std::size_t a = 0; a < 3; ++a)
      m_dims[a] = static_cast<int>(std::ceil(box.sizes()[static_cast<Eigen::Index>(a)] / step)) + 4;
    sample(distance);
    cut(distance);
  }

  core::TriangleMesh take() { return std::move(m_mesh); }

private:
  static constexpr int kBlock = 6;

  std::size_t index(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(m_dims[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(m_dims[0]) +
           static_cast<std::size_t>(i);
  }
  shapes::Point at(double i, double j, double k) const
  {
    return m_origin + m_step * Eigen::Vector3d(i, j, k);
  }

  /// Blocks without a border get the value of their centre everywhere.
  template <class Distance>
  void sample(const Distance& distance)
  {
    m_values.resize(index(0, 0, m_dims[2]));
    const double reach = 0.5 * std::sqrt(3.0) * kBlock * m_step;
    const int slabs = (m_dims[2] + kBlock - 1) / kBlock;
    tbb::parallel_for(0, slabs,
                      [&](int slab)
                      {
                        const int k0 = slab * kBlock;
                        const int k1 = std::min(k0 + kBlock, m_dims[2]);
                        for (int j0 = 0; j0 < m_dims[1]; j0 += kBlock)
                          for (int i0 = 0; i0 < m_dims[0]; i0 += kBlock)
                          {
                            const double half = 0.5 * (kBlock - 1);
                            const double middle = distance(at(i0 + half, j0 + half, k0 + half));
                            const bool far = middle > kOutside * reach || middle < -kInside * reach;
                            for (int k = k0; k < k1; ++k)
                              for (int j = j0; j < std::min(j0 + kBlock, m_dims[1]); ++j)
                                for (int i = i0; i < std::min(i0 + kBlock, m_dims[0]); ++i)
                                  m_values[index(i, j, k)] =
                                      static_cast<float>(far ? middle : distance(at(i, j, k)));
                          }
                      });
  }

  template <class Distance>
  void cut(const Distance& distance)
  {
    // the six tetrahedra of a cube share the diagonal 0-7; corners are bits x, y, z
    static constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
        {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
    for (int k = 0; k + 1 < m_dims[2]; ++k)
      for (int j = 0; j + 1 < m_dims[1]; ++j)
        for (int i = 0; i + 1 < m_dims[0]; ++i)
        {
          unsigned inside = 0;
          for (int c = 0; c < 8; ++c)
            if (value(i, j, k, c) < 0.0F)
              inside |= 1U << c;
          if (inside == 0 || inside == 0xFF)
            continue;
          for (const auto& tetrahedron : kTetrahedra)
            cutTetrahedron(distance, i, j, k, inside, tetrahedron);
        }
  }

  float value(int i, int j, int k, int corner) const
  {
    return m_values[index(i + (corner & 1), j + ((corner >> 1) & 1), k + (corner >> 2))];
  }

  template <class Distance>
  void cutTetrahedron(const Distance& distance, int i, int j, int k, unsigned inside,
                      const std::array<int, 4>& corners)
  {
    std::array<int, 4> in{};
    std::array<int, 4> out{};
    std::size_t ins = 0;
    std::size_t outs = 0;
    for (const int c : corners)
      ((inside >> c) & 1U) ? in[ins++] = c : out[outs++] = c;
    const auto vertex = [&](int a, int b) { return edgeVertex(distance, i, j, k, a, b); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
      // oriented outwards: away from an inside corner
      const auto& v = m_mesh.vertices;
      const Eigen::Vector3d ref = at(i + (in[0] & 1), j + ((in[0] >> 1) & 1), k + (in[0] >> 2));
      const Eigen::Vector3d va = v[a].cast<double>();
      const Eigen::Vector3d normal = (v[b].cast<double>() - va).cross(v[c].cast<double>() - va);
      if (normal.dot(va - ref) >= 0.0)
        m_mesh.triangles.push_back({a, b, c});
      else
        m_mesh.triangles.push_back({a, c, b});
    };
    if (ins == 1)
      add(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]));
    else if (ins == 3)
      add(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]));
    else if (ins == 2)
    {
      const std::uint32_t a = vertex(in[0], out[0]);
      const std::uint32_t b = vertex(in[0], out[1]);
      const std::uint32_t c = vertex(in[1], out[1]);
      const std::uint32_t d = vertex(in[1], out[0]);
      add(a, b, c);
      add(a, c, d);
    }
  }

  /// Position of the border on an edge, by regula falsi on the signed distance itself.
  template <class Distance>
  std::uint32_t edgeVertex(const Distance& distance, int i, int j, int k, int a, int b)
  {
    const int low = std::min(a, b);
    const int high = std::max(a, b);
    const std::size_t key = index(i + (low & 1), j + ((low >> 1) & 1), k + (low >> 2)) * 8 +
                            static_cast<std::size_t>(high - low);
    const auto [entry, fresh] =
        m_vertexOf.try_emplace(key, static_cast<std::uint32_t>(m_mesh.vertices.size()));
    if (!fresh)
      return entry->second;
    const shapes::Point p = at(i + (low & 1), j + ((low >> 1) & 1), k + (low >> 2));
    const shapes::Point q = at(i + (high & 1), j + ((high >> 1) & 1), k + (high >> 2));
    double t0 = 0.0;
    double t1 = 1.0;
    double f0 = value(i, j, k, low);
    double f1 = value(i, j, k, high);
    double t = 0.5;
    for (int round = 0; round < 4; ++round)
    {
      t = std::clamp(t0 + (t1 - t0) * f0 / (f0 - f1), t0 + 0.05 * (t1 - t0), t1 - 0.05 * (t1 - t0));
      const double f = distance(p + t * (q - p));
      if ((f < 0.0) == (f0 < 0.0))
      {
        t0 = t;
        f0 = f;
      }
      else
      {
        t1 = t;
        f1 = f;
      }
    }
    t = std::clamp(t0 + (t1 - t0) * f0 / (f0 - f1), 0.01, 0.99); // no two coincident vertices
    m_mesh.vertices.push_back((p + t * (q - p)).cast<float>());
    return entry->second;
  }

  Eigen::Vector3d m_origin;
  double m_step;
  core::Index3 m_dims{};
  std::vector<float> m_values;
  std::unordered_map<std::size_t, std::uint32_t> m_vertexOf;
  core::TriangleMesh m_mesh;
};

} // namespace

double Phantom::volume(std::size_t structure, const core::PatientBox& within) const
{
  const shapes::Box box = m_scene->layers[m_scene->layerOf[structure]].shape.box.intersection(
      shapes::Box(within.min(), within.max()));
  if (box.isEmpty())
    return 0.0;
  const double mesh = m_scene->layers[m_scene->layerOf[structure]].mesh;
  const double resolution = mesh > 0.0 ? mesh : 0.2;
  const Eigen::Vector3d size = box.sizes();
  const Eigen::Array3i cells = (size.array() / 2.0).ceil().cast<int>().max(1);
  const Eigen::Vector3d edge = size.array() / cells.cast<double>();
  const std::size_t layer = m_scene->layerOf[structure];

  const auto measure = [&](double finest)
  {
    // one sum per layer of cells, added in order: independent of thread scheduling
    std::vector<double> sums(static_cast<std::size_t>(cells[2]), 0.0);
    tbb::parallel_for(0, cells[2],
                      [&](int k)
                      {
                        double sum = 0.0;
                        for (int j = 0; j < cells[1]; ++j)
                          for (int i = 0; i < cells[0]; ++i)
                            sum += cellVolume(*m_scene, layer, nullptr,
                                              box.min() + edge.cwiseProduct(Eigen::Vector3d(
                                                              i + 0.5, j + 0.5, k + 0.5)),
                                              edge, finest);
                        sums[static_cast<std::size_t>(k)] = sum;
                      });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  };
  // The coverage error of a border cell is proportional to the square of its edge where the border
  // is curved: two edges, one twice the other, cancel it (Richardson extrapolation).
  return (4.0 * measure(resolution) - measure(2.0 * resolution)) / 3.0;
}

core::TriangleMesh Phantom::surface(std::size_t structure, const core::PatientBox& within,
                                    double resolution) const
{
  const anatomy::Layer& layer = m_scene->layers[m_scene->layerOf[structure]];
  const shapes::Box clip(within.min(), within.max());
  const shapes::Box box = layer.shape.box.intersection(clip);
  if (box.isEmpty())
    return {};
  const double step = resolution > 0.0 ? resolution : (layer.mesh > 0.0 ? layer.mesh : 0.3);
  const auto distance = [&](const shapes::Point& p)
  { return std::max(m_scene->distance(structure, p), boxDistance(clip, p)); };
  return Polygoniser(box, step, distance).take();
}

} // namespace petrous::phantom
