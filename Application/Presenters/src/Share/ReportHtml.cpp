#include <algorithm>
#include <cmath>
#include <cstddef>

#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/PlanReport.h"

namespace petrous::presenters
{

namespace
{

constexpr const char* kStyle = R"css(
@page { size: A4; margin: 16mm 15mm 18mm 15mm; }
* { box-sizing: border-box; }
html { color: #1a2430; background: #fff; -webkit-print-color-adjust: exact;
       print-color-adjust: exact; }
body { font: 10.5pt/1.45 "Noto Sans", "DejaVu Sans", "Segoe UI", Arial, sans-serif;
       max-width: 190mm; margin: 0 auto; padding: 8mm 5mm; }
header { border-bottom: 2.5pt solid #14506e; padding-bottom: 3mm; margin-bottom: 4mm;
         display: flex; justify-content: space-between; align-items: flex-end; gap: 8mm; }
h1 { font-size: 21pt; margin: 0; color: #14506e; font-weight: 600; }
h1 small { display: block; font-size: 12pt; color: #1a2430; font-weight: 400; }
.side { font-size: 15pt; font-weight: 700; padding: 1.5mm 4mm; border: 2pt solid #14506e;
        color: #14506e; border-radius: 2mm; white-space: nowrap; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 1mm 6mm; margin: 0 0 5mm; }
dt { color: #5a6875; }
dd { margin: 0; white-space: pre-wrap; }
h2 { font-size: 13pt; color: #14506e; margin: 7mm 0 2mm; border-bottom: .6pt solid #b9c6d0;
     padding-bottom: 1mm; break-after: avoid; }
h3 { font-size: 10.5pt; margin: 3mm 0 1mm; break-after: avoid; }
p { margin: 0 0 2mm; }
.warning { color: #a03410; font-weight: 600; }
.remark { color: #5a6875; font-size: 9pt; }
table { border-collapse: collapse; width: 100%; margin: 1mm 0 2mm; font-size: 9.5pt; }
th { text-align: left; font-weight: 600; color: #14506e; border-bottom: 1pt solid #14506e;
     padding: 1mm 2.5mm 1mm 0; vertical-align: bottom; }
td { border-bottom: .4pt solid #d6dee4; padding: .9mm 2.5mm .9mm 0; vertical-align: top; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
tr { break-inside: avoid; }
thead { display: table-header-group; }
.swatch { display: inline-block; width: 3mm; height: 3mm; border-radius: .6mm;
          border: .4pt solid #8a96a0; margin-right: 2mm; vertical-align: -0.3mm; }
.pictures { display: grid; gap: 3mm; margin: 1mm 0 3mm; }
figure { margin: 0; break-inside: avoid; }
figure img { width: 100%; display: block; border-radius: 1mm; }
figcaption { font-size: 9pt; color: #5a6875; margin-top: .8mm; }
footer { margin-top: 8mm; border-top: .6pt solid #b9c6d0; padding-top: 2mm; color: #5a6875;
         font-size: 8.5pt; }
)css";

void addCell(std::string& html, const ReportCell& cell)
{
  html += "<td";
  std::string classes = cell.isNumber ? "number" : "";
  if (cell.isWarning)
    classes += classes.empty() ? "warning" : " warning";
  if (!classes.empty())
    html += " class=\"" + classes + "\"";
  if (cell.value)
    html += " data-value=\"" + core::exactText(*cell.value) + "\"";
  if (cell.uncertainty)
    html += " data-uncertainty=\"" + core::exactText(*cell.uncertainty) + "\"";
  html += ">";
  if (cell.color)
  {
    html += "<span class=\"swatch\" style=\"background:rgb(";
    for (std::size_t c = 0; c < 3; ++c)
      html += (c == 0 ? "" : ",") +
              std::to_string(std::lround(255.0 * static_cast<double>((*cell.color)[c])));
    html += ")\"></span>";
  }
  html += escapedHtml(shownText(cell)) + "</td>";
}

void addTable(std::string& html, const ReportTable& table)
{
  if (table.rows.empty())
    return;
  html += "<table><thead><tr>";
  for (std::size_t n = 0; n < table.columns.size(); ++n)
    html += std::string("<th") + (table.rows.front()[n].isNumber ? " class=\"number\">" : ">") +
            escapedHtml(table.columns[n]) + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows)
  {
    html += "<tr>";
    for (const ReportCell& cell : row)
      addCell(html, cell);
    html += "</tr>\n";
  }
  html += "</tbody></table>\n";
}

void addPictures(std::string& html, const std::vector<ReportPicture>& pictures)
{
  if (pictures.empty())
    return;
  for (const ReportPicture& picture : pictures)
  {
    const bool isFirst = &picture == &pictures.front();
    if (isFirst || !picture.heading.empty())
    {
      if (!isFirst)
        html += "</div>\n";
      if (!picture.heading.empty())
        html += "<h3>" + escapedHtml(picture.heading) + "</h3>\n";
      html += "<div class=\"pictures\" style=\"grid-template-columns:repeat(" +
              std::to_string(picture.inRow) + ",1fr)\">\n";
    }
    const std::string caption = escapedHtml(picture.caption);
    html += "<figure><img alt=\"" + caption + "\" width=\"" + std::to_string(picture.width) +
            "\" height=\"" + std::to_string(picture.height) +
            "\" style=\"height:auto\" src=\"data:image/png;base64," + base64(picture.png) +
            "\"><figcaption>" + caption + "</figcaption></figure>\n";
  }
  html += "</div>\n";
}

} // namespace

std::string shownText(const ReportCell& cell)
{
  return cell.color ? shownName(cell.text) : cell.text;
}

std::string escapedHtml(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
    switch (c)
    {
    case '&':
      escaped += "&amp;";
      break;
    case '<':
      escaped += "&lt;";
      break;
    case '>':
      escaped += "&gt;";
      break;
    case '"':
      escaped += "&quot;";
      break;
    case '\'':
      escaped += "&#39;";
      break;
    default:
      escaped += c;
    }
  return escaped;
}

std::string base64(const std::vector<std::uint8_t>& bytes)
{
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3)
  {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - n);
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = (group << 8) | (b < count ? bytes[n + b] : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text += digit <= count ? kDigits[(group >> (18 - 6 * digit)) & 63U] : '=';
  }
  return text;
}

std::string htmlOf(const PlanReport& report)
{
  std::string html =
      std::string("<!DOCTYPE html>\n<html lang=\"") +
      (report.language == ReportLanguage::German ? "de" : "en") +
      "\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      escapedHtml(report.title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n";
  html += "<header><h1>" + escapedHtml(report.title) + "<small>" + escapedHtml(report.name) +
          "</small></h1><div class=\"side\">" + escapedHtml(report.side) +
          "</div></header>\n<dl>\n";
  for (const auto& [name, text] : report.facts)
    html += "<dt>" + escapedHtml(name) + "</dt><dd>" + escapedHtml(text) + "</dd>\n";
  html += "</dl>\n";
  for (const ReportSection& section : report.sections)
  {
    html += "<section id=\"" + section.id + "\">\n<h2>" + escapedHtml(section.title) + "</h2>\n";
    for (const std::string& paragraph : section.paragraphs)
      html += "<p>" + escapedHtml(paragraph) + "</p>\n";
    addPictures(html, section.pictures);
    addTable(html, section.table);
    for (const std::string& remark : section.remarks)
      html += "<p class=\"remark\">" + escapedHtml(remark) + "</p>\n";
    html += "</section>\n";
  }
  html += "<footer>" + escapedHtml(report.colophon) + "</footer>\n</body>\n</html>\n";
  return html;
}

} // namespace petrous::presenters
