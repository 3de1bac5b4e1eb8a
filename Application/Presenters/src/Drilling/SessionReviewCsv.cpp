#include "petrous/Core/CsvTable.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Presenters/SessionReview.h"

namespace petrous::presenters
{

std::string metricsCsv(const SessionReview& review)
{
  std::vector<std::vector<std::string>> rows{{"quantity", "structure", "value", "unit"}};
  const auto add = [&rows](const std::string& quantity, const std::string& structure, double value,
                           int decimals, const std::string& unit) {
    rows.push_back({quantity, structure, core::fixedText(value, decimals), unit});
  };
  const SessionMetrics& metrics = review.metrics;
  rows.push_back({"burr", "", dissection::nameOf(review.burr), ""});
  add("burr_diameter", "", review.burr.diameter, 2, "mm");
  add("spindle_speed", "", review.burr.rpm, 0, "1/min");
  if (review.speed)
  {
    add("mean_spindle_speed_drilling", "", review.speed->mean, 0, "1/min");
    add("max_spindle_speed", "", review.speed->max, 0, "1/min");
  }
  add("duration", "", metrics.duration, 3, "s");
  add("drilling", "", metrics.drilling, 3, "s");
  add("drill_starts", "", static_cast<double>(metrics.drillStarts), 0, "");
  add("path", "", metrics.path, 2, "mm");
  add("drilling_path", "", metrics.drillingPath, 2, "mm");
  add("mean_force_drilling", "", metrics.meanForce, 3, "N");
  add("max_force", "", metrics.maxForce, 3, "N");
  add("max_thrust", "", metrics.maxThrust, 3, "N");
  if (review.removed)
  {
    add("strokes", "", static_cast<double>(review.strokes), 0, "");
    add("removed_volume", "", *review.removed, 3, "mm3");
  }
  for (const SessionReview::Structure& one : review.structures)
  {
    if (one.nearest)
      add("nearest_distance", one.name, *one.nearest, 3, "mm");
    if (one.removed)
      add("removed_volume", one.name, *one.removed, 3, "mm3");
  }
  return core::csvText(rows, ',');
}

namespace
{

constexpr const char* kCourse = "t_s,x_mm,y_mm,z_mm,ax,ay,az,drill,force_n,thrust_n,rpm";

// A row per sample, from `begin` on, with `end` at the end of each.
std::string courseRows(const SessionReview& review, double begin, const std::string& end)
{
  std::string text;
  for (const RecordedTool& tool : review.course)
  {
    text += core::fixedText(begin + tool.time, 4);
    for (const double value : {tool.center.x(), tool.center.y(), tool.center.z()})
      text += "," + core::fixedText(value, 4);
    for (const double value : {tool.axisToHand.x(), tool.axisToHand.y(), tool.axisToHand.z()})
      text += "," + core::fixedText(value, 6);
    text += std::string(",") + (tool.drilling ? "1" : "0") + "," + core::fixedText(tool.force, 4) +
            "," + core::fixedText(tool.thrust, 4) + "," +
            core::fixedText(review.burr.rpm * tool.spindle, 0) + end + "\n";
  }
  return text;
}

std::string textOf(const std::optional<double>& value, int decimals)
{
  return value ? core::fixedText(*value, decimals) : std::string();
}

const SessionReview::Structure* find(const SessionReview& review, const std::string& name)
{
  for (const SessionReview::Structure& one : review.structures)
    if (one.name == name)
      return &one;
  return nullptr;
}

} // namespace

std::string courseCsv(const SessionReview& review)
{
  return std::string(kCourse) + "\n" + courseRows(review, 0.0, {});
}

std::string operationCourseCsv(const OperationReview& review)
{
  std::string text = std::string(kCourse) + ",part\n";
  for (std::size_t n = 0; n < review.parts.size(); ++n)
    text += courseRows(review.parts[n].review, review.parts[n].begin, "," + std::to_string(n + 1));
  return text;
}

std::string operationCsv(const OperationReview& review)
{
  std::vector<std::vector<std::string>> rows{
      {"part", "recording", "burr", "burr_diameter_mm", "spindle_speed_rpm", "duration_s",
       "drilling_s", "drill_starts", "path_mm", "drilling_path_mm", "mean_force_drilling_n",
       "max_force_n", "max_thrust_n", "strokes", "removed_mm3"}};
  for (const SessionReview::Structure& one : review.structures)
  {
    for (const char* quantity : {"nearest_mm", "removed_mm3"})
      rows.front().push_back(quantity + (' ' + one.name));
  }
  const auto add = [&](std::vector<std::string> row, const SessionReview& part)
  {
    const SessionMetrics& m = part.metrics;
    const std::vector<std::string> values{core::fixedText(m.duration, 3),
                                          core::fixedText(m.drilling, 3),
                                          std::to_string(m.drillStarts),
                                          core::fixedText(m.path, 2),
                                          core::fixedText(m.drillingPath, 2),
                                          core::fixedText(m.meanForce, 3),
                                          core::fixedText(m.maxForce, 3),
                                          core::fixedText(m.maxThrust, 3),
                                          part.removed ? std::to_string(part.strokes) : "",
                                          textOf(part.removed, 3)};
    row.insert(row.end(), values.begin(), values.end());
    for (const SessionReview::Structure& column : review.structures)
    {
      const SessionReview::Structure* one = find(part, column.name);
      row.push_back(one ? textOf(one->nearest, 3) : "");
      row.push_back(one ? textOf(one->removed, 3) : "");
    }
    rows.push_back(std::move(row));
  };
  for (std::size_t n = 0; n < review.parts.size(); ++n)
  {
    const SessionReview& part = review.parts[n].review;
    add({std::to_string(n + 1), review.parts[n].name, dissection::nameOf(part.burr),
         core::fixedText(part.burr.diameter, 2), core::fixedText(part.burr.rpm, 0)},
        part);
  }
  add({"total", "", "", "", ""}, review);
  return core::csvText(rows, ',');
}

} // namespace petrous::presenters
