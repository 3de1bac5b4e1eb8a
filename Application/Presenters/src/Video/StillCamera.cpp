#include "petrous/Presenters/StillCamera.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <Eigen/Geometry>

#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"

namespace petrous::presenters
{

namespace
{

using Landmarks = std::vector<scene::VideoNotes::Landmark>;
using Still = scene::VideoNotes::Still;

constexpr double kPi = 3.14159265358979323846;
constexpr double kStandsOut = 4.0; // times the residual of the others

registration::StillPose poseOf(const Landmarks& landmarks, const Still& still)
{
  std::vector<registration::StillLandmark> pairs;
  for (const auto& one : landmarks)
    pairs.push_back({one.patient, one.still});
  return registration::poseOfStill(pairs, still.size, still.viewAngle);
}

Landmarks without(const Landmarks& all, const std::vector<std::size_t>& some)
{
  Landmarks others;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (std::find(some.begin(), some.end(), n) == some.end())
      others.push_back(all[n]);
  return others;
}

// Those `count` landmarks, 1 or 2, without which the others fit, if they then stand out.
std::vector<std::size_t> worstOf(const Still& still, std::size_t count, double good,
                                 const core::Progress& progress)
{
  const Landmarks& all = still.landmarks;
  std::vector<std::size_t> worst;
  double least = good;
  const auto consider = [&](const std::vector<std::size_t>& some)
  {
    try
    {
      const auto pose = poseOf(without(all, some), still);
      if (pose.rms >= least)
        return;
      for (const std::size_t n : some)
        if (const auto seen = seenAt(pose.camera, still.size, all[n].patient);
            seen && (*seen - all[n].still).norm() <= kStandsOut * std::max(pose.rms, 0.5 * good))
          return;
      worst = some;
      least = pose.rms;
    }
    catch (const core::InvalidParameter&)
    {
      // The others leave the camera open.
    }
  };
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(all.size()),
                    "looking for landmarks that do not fit");
    if (count == 1)
      consider({n});
    else
      for (std::size_t m = n + 1; m < all.size(); ++m)
      {
        progress.check("looking for landmarks that do not fit");
        consider({n, m});
      }
  }
  return worst;
}

} // namespace

double residualOfGoodClicks(int height) noexcept
{
  return std::max(2.0, 0.004 * height);
}

std::size_t landmarksNeeded(const Still& still) noexcept
{
  return still.viewAngle ? 4 : 6;
}

StillFit fitStill(const Still& still, const core::Progress& progress)
{
  StillFit fit;
  const double good = residualOfGoodClicks(still.size[1]);
  const std::size_t count = still.landmarks.size();
  // One more than needed must be left: where as many are left as are needed, the rest fits whatever
  // is left out.
  const std::size_t spare = count - std::min(count, landmarksNeeded(still) + 1);
  std::optional<core::InvalidParameter> refusal;
  try
  {
    fit.pose = poseOf(still.landmarks, still);
    if (fit.pose.rms <= good)
      return fit;
  }
  catch (const core::InvalidParameter& error) // one that is wrong may leave all open
  {
    refusal = error;
  }
  for (std::size_t n = 1; n <= std::min<std::size_t>(2, spare) && fit.bad.empty(); ++n)
    fit.bad = worstOf(still, n, good, progress);
  if (fit.bad.empty())
  {
    if (refusal)
      throw *refusal;
    fit.isPoor = true;
    return fit;
  }
  fit.pose = poseOf(without(still.landmarks, fit.bad), still);
  fit.pose.residuals.clear();
  for (const auto& one : still.landmarks)
  {
    const auto seen = seenAt(fit.pose.camera, still.size, one.patient);
    fit.pose.residuals.push_back(seen ? (*seen - one.still).norm()
                                      : std::hypot(still.size[0], still.size[1]));
  }
  return fit;
}

std::optional<Eigen::Vector2d> seenAt(const core::CameraPose& camera,
                                      const std::array<int, 2>& size,
                                      const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d into = (camera.focalPoint - camera.position).normalized();
  const Eigen::Vector3d right = into.cross(camera.viewUp).normalized();
  const Eigen::Vector3d q = patient - camera.position;
  if (q.dot(into) <= 0.0)
    return std::nullopt;
  const double scale = 0.5 * size[1] / (std::tan(camera.viewAngle * kPi / 360.0) * q.dot(into));
  return Eigen::Vector2d(0.5 * size[0] + scale * q.dot(right),
                         0.5 * size[1] - scale * q.dot(right.cross(into)));
}

Landmarks landmarksFromCsv(std::istream& csv, const std::string& name)
{
  Landmarks landmarks;
  core::readCsv(csv, name, {"x_mm", "y_mm", "z_mm", "u_px", "v_px"},
                [&landmarks](std::size_t /*line*/, const std::vector<double>& v) {
                  landmarks.push_back({{v[0], v[1], v[2]}, {v[3], v[4]}});
                });
  return landmarks;
}

rendering::Picture overlaid(rendering::Picture picture, const video::Frame& still, double opacity)
{
  if (!still.pixels || still.width < 1 || still.height < 1)
    return picture;
  const double scale = static_cast<double>(still.height) / picture.height; // still pixels a pixel
  const auto texel = [&still](int x, int y, int channel)
  {
    x = std::clamp(x, 0, still.width - 1);
    y = std::clamp(y, 0, still.height - 1);
    return static_cast<double>(
        (*still.pixels)[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(still.width) +
                             static_cast<std::size_t>(x)) +
                        static_cast<std::size_t>(channel)]);
  };
  std::size_t at = 0;
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column, at += 3)
    {
      const double u = 0.5 * still.width + scale * (column + 0.5 - 0.5 * picture.width);
      const double v = scale * (row + 0.5);
      if (u < 0.0 || u > still.width)
        continue;
      const double x = std::floor(u - 0.5);
      const double y = std::floor(v - 0.5);
      const double fx = u - 0.5 - x;
      const double fy = v - 0.5 - y;
      const int i = static_cast<int>(x);
      const int j = static_cast<int>(y);
      for (int c = 0; c < 3; ++c)
      {
        const double seen = (1.0 - fy) * ((1.0 - fx) * texel(i, j, c) + fx * texel(i + 1, j, c)) +
                            fy * ((1.0 - fx) * texel(i, j + 1, c) + fx * texel(i + 1, j + 1, c));
        std::uint8_t& pixel = picture.rgb[at + static_cast<std::size_t>(c)];
        pixel = static_cast<std::uint8_t>(
            std::lround((1.0 - opacity) * static_cast<double>(pixel) + opacity * seen));
      }
    }
  return picture;
}

rendering::Picture pictureOf(const video::Frame& frame)
{
  return {frame.width, frame.height, frame.pixels ? *frame.pixels : std::vector<std::uint8_t>()};
}

std::string timeText(std::int64_t nanoseconds)
{
  const std::int64_t milliseconds = nanoseconds / 1'000'000;
  const int hours = static_cast<int>(milliseconds / 3'600'000);
  const int minutes = static_cast<int>(milliseconds / 60'000 % 60);
  const int seconds = static_cast<int>(milliseconds / 1000 % 60);
  const int rest = static_cast<int>(milliseconds % 1000);
  char text[64];
  if (hours > 0)
    std::snprintf(text, sizeof text, "%d:%02d:%02d.%03d", hours, minutes, seconds, rest);
  else
    std::snprintf(text, sizeof text, "%02d:%02d.%03d", minutes, seconds, rest);
  return text;
}

} // namespace petrous::presenters
