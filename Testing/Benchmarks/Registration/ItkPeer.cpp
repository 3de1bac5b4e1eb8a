#include <chrono>
#include <vector>

#include "ChildProcess.h"
#include "ItkMattes.h"
#include "PeerRegistration.h"

namespace petrous::registration
{

namespace
{

std::vector<float> floatsOf(const volume::IntensityVolume& image)
{
  return image.visit(
      [](const auto& voxels)
      {
        std::vector<float> result(voxels.size());
        for (std::size_t n = 0; n < result.size(); ++n)
          result[n] = static_cast<float>(voxels.data()[n]);
        return result;
      });
}

itkpeer::Image peerImage(const core::GridGeometry& grid, std::vector<float>& voxels)
{
  itkpeer::Image image{grid.dims(), {}, {}, {}, voxels.data()};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto row = static_cast<Eigen::Index>(a);
    image.spacing[a] = grid.spacing()[row];
    image.origin[a] = grid.origin()[row];
    for (std::size_t b = 0; b < 3; ++b)
      image.direction[3 * a + b] = grid.direction()(row, static_cast<Eigen::Index>(b));
  }
  return image;
}

} // namespace

std::string itkVersion()
{
  return itkpeer::version();
}

std::optional<PeerFit> runItk(const RegistrationPair& pair)
{
  std::vector<float> fixed = floatsOf(*pair.ct), moving = floatsOf(*pair.mr);
  const Vector3d center = pair.ct->geometry().center();
  std::array<double, 12> m{};
  const double spent = processorSeconds();
  const auto start = std::chrono::steady_clock::now();
  if (!itkpeer::register3d(peerImage(pair.ct->geometry(), fixed),
                           peerImage(pair.mr->geometry(), moving),
                           {center.x(), center.y(), center.z()}, m))
    return std::nullopt;
  PeerFit fit;
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fit.processorSeconds = processorSeconds() - spent;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(m.data());
  fit.mrFromCt = {Eigen::Quaterniond(Eigen::Matrix3d(matrix.leftCols<3>())), matrix.col(3)};
  return fit;
}

} // namespace petrous::registration
