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

std::string courseCsv(const SessionReview& review)
{
  std::string text = "t_s,x_mm,y_mm,z_mm,ax,ay,az,drill,force_n,thrust_n,rpm\n";
  for (const RecordedTool& tool : review.course)
  {
    text += core::fixedText(tool.time, 4);
    for (const double value : {tool.center.x(), tool.center.y(), tool.center.z()})
      text += "," + core::fixedText(value, 4);
    for (const double value : {tool.axisToHand.x(), tool.axisToHand.y(), tool.axisToHand.z()})
      text += "," + core::fixedText(value, 6);
    text += std::string(",") + (tool.drilling ? "1" : "0") + "," + core::fixedText(tool.force, 4) +
            "," + core::fixedText(tool.thrust, 4) + "," +
            core::fixedText(review.burr.rpm * tool.spindle, 0) + "\n";
  }
  return text;
}

} // namespace petrous::presenters
