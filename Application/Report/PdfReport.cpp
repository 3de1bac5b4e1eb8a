#include "PdfReport.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <memory>

#include <QAbstractTextDocumentLayout>
#include <QBuffer>
#include <QFontDatabase>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <QPdfWriter>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextFrame>
#include <QTextLayout>
#include <QTextTable>
#include <QUrl>
#include <QVector>

#include "petrous/Core/Error.h"

namespace petrous::report
{

namespace
{

using presenters::ReportCell;
using presenters::ReportPicture;
using presenters::ReportSection;
using presenters::ReportTable;

// All lengths are CSS pixels, 96 an inch.
constexpr double kMillimetre = 96.0 / 25.4;
constexpr double kPageWidth = 210.0 * kMillimetre;
constexpr double kPageHeight = 297.0 * kMillimetre;
constexpr double kMargin = 16.0 * kMillimetre;
constexpr double kHead = 20.0 * kMillimetre; // above the text, with the stamp
constexpr double kFoot = 18.0 * kMillimetre; // below it, with the page's number
constexpr double kTextWidth = kPageWidth - 2.0 * kMargin;
// A whole number: Qt lays out in 64ths, and a line on top of the next page would touch this one.
constexpr double kTextHeight = static_cast<int>(kPageHeight - kHead - kFoot);
constexpr int kResolution = 1200; // dots per inch, of coordinates

const char* const kInk = "#1a2430";
const char* const kAccent = "#14506e";
const char* const kDim = "#5a6875";

/// QFont needs an application. QCoreApplication sets the locale of the user, by which the C library
/// would write numbers: it is put back.
class Application
{
public:
  Application()
  {
    if (QCoreApplication::instance())
      return;
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const QByteArray platform = qgetenv("QT_QPA_PLATFORM");
    const QtMessageHandler told =
        qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    qputenv("QT_QPA_PLATFORM", "offscreen");
    m_application = std::make_unique<QGuiApplication>(m_count, m_words);
    platform.isNull() ? qunsetenv("QT_QPA_PLATFORM") : qputenv("QT_QPA_PLATFORM", platform);
    qInstallMessageHandler(told); // it was of folders of a desktop, which are not needed
    std::setlocale(LC_ALL, before.c_str());
  }

private:
  int m_count = 1;
  char m_name[8] = "petrous";
  char* m_words[2] = {m_name, nullptr};
  std::unique_ptr<QGuiApplication> m_application;
};

QString words(const std::string& text)
{
  return QString::fromStdString(text);
}

QString escaped(const std::string& text)
{
  return words(presenters::escapedHtml(text)).replace('\n', "<br>");
}

QString cellHtml(const ReportCell& cell, const QString& tag)
{
  QString html =
      QString("<%1 align=\"%2\" valign=\"top\">").arg(tag, cell.isNumber ? "right" : "left");
  if (cell.color)
  {
    const auto level = [&cell](std::size_t c)
    { return static_cast<int>(std::lround(255.0 * static_cast<double>((*cell.color)[c]))); };
    html += QString("<span style=\"background-color:#%1%2%3\">&nbsp;&nbsp;&nbsp;</span>&nbsp;")
                .arg(level(0), 2, 16, QChar('0'))
                .arg(level(1), 2, 16, QChar('0'))
                .arg(level(2), 2, 16, QChar('0'));
  }
  QString text = escaped(presenters::shownText(cell));
  if (cell.isNumber)
    text.replace(' ', "&nbsp;");
  if (cell.isWarning)
    text = "<b><span style=\"color:#a03410\">" + text + "</span></b>";
  return html + text + "</" + tag + ">";
}

QString tableHtml(const ReportTable& table)
{
  if (table.rows.empty())
    return {};
  QString html = "<table width=\"100%\" cellspacing=\"0\" cellpadding=\"3\" border=\"0\" "
                 "style=\"font-size:8.5pt\"><thead><tr>";
  for (std::size_t n = 0; n < table.columns.size(); ++n)
    html += QString("<th align=\"%1\" valign=\"bottom\" style=\"color:%2;background-color:"
                    "#e4edf2\">%3</th>")
                .arg(table.rows.front()[n].isNumber ? "right" : "left", kAccent,
                     escaped(table.columns[n]));
  html += "</tr></thead>";
  bool isOdd = false;
  for (const auto& row : table.rows)
  {
    html += isOdd ? "<tr bgcolor=\"#f4f7f9\">" : "<tr>";
    isOdd = !isOdd;
    for (const ReportCell& cell : row)
      html += cellHtml(cell, "td");
    html += "</tr>";
  }
  return html + "</table><p style=\"font-size:3pt;margin:0px\">&nbsp;</p>";
}

QUrl urlOf(std::size_t picture)
{
  return QUrl("picture:" + QString::number(picture));
}

/// `pictures`: of the document so far.
QString picturesHtml(const std::vector<ReportPicture>& all,
                     std::vector<const ReportPicture*>& pictures)
{
  QString html;
  for (std::size_t n = 0; n < all.size();)
  {
    const int inRow = std::max(all[n].inRow, 1);
    const int width = static_cast<int>(kTextWidth / inRow) - 8;
    if (!all[n].heading.empty())
      html += "<h3 style=\"font-size:9.5pt;margin-top:10px;margin-bottom:3px\">" +
              escaped(all[n].heading) + "</h3>";
    html += "<table width=\"100%\" cellspacing=\"0\" cellpadding=\"2\" border=\"0\"><tr>";
    bool isInRow = true;
    for (int column = 0; column < inRow; ++column)
    {
      html += QString("<td width=\"%1%\" valign=\"top\">").arg(100 / inRow);
      isInRow = n < all.size() && isInRow && (column == 0 || all[n].heading.empty());
      if (isInRow)
      {
        html += QString("<p style=\"margin:0px\"><img src=\"%1\" width=\"%2\" height=\"%3\"></p>"
                        "<p style=\"font-size:7.5pt;color:%4;margin-top:5px;margin-bottom:2px\">%5"
                        "</p>")
                    .arg(urlOf(pictures.size()).toString())
                    .arg(width)
                    .arg(width * all[n].height / std::max(all[n].width, 1))
                    .arg(kDim, escaped(all[n].caption));
        pictures.push_back(&all[n++]);
      }
      html += "</td>";
    }
    html += "</tr></table>";
  }
  return html;
}

QString sectionHtml(const ReportSection& section, std::vector<const ReportPicture*>& pictures)
{
  QString html = QString("<h2 style=\"font-size:12pt;color:%1;margin-top:16px;margin-bottom:4px\">"
                         "%2</h2>")
                     .arg(kAccent, escaped(section.title));
  for (const std::string& paragraph : section.paragraphs)
    html += "<p style=\"margin-top:2px;margin-bottom:4px\">" + escaped(paragraph) + "</p>";
  html += picturesHtml(section.pictures, pictures);
  html += tableHtml(section.table);
  for (const std::string& remark : section.remarks)
    html += QString("<p style=\"font-size:8pt;color:%1;margin-top:4px;margin-bottom:2px\">%2</p>")
                .arg(kDim, escaped(remark));
  return html;
}

QString factsHtml(const presenters::PlanReport& report)
{
  QString html = "<table cellspacing=\"0\" cellpadding=\"2\" border=\"0\">";
  for (const auto& [name, text] : report.facts)
    html += QString("<tr><td style=\"color:%1\">%2&nbsp;&nbsp;&nbsp;</td><td>%3</td></tr>")
                .arg(kDim, escaped(name), escaped(text));
  return html + "</table>";
}

/// Of a cell's text at its fonts, without its line breaks.
double widthOf(const QTextTableCell& cell)
{
  double width = 0.0;
  for (QTextBlock block = cell.firstCursorPosition().block();
       block.isValid() && block.position() <= cell.lastPosition(); block = block.next())
  {
    double line = 0.0;
    for (auto at = block.begin(); !at.atEnd(); ++at)
      line +=
          QFontMetricsF(at.fragment().charFormat().font()).horizontalAdvance(at.fragment().text());
    width = std::max(width, line);
  }
  return width;
}

/// Columns of numbers are as wide as these, which else break anywhere where room is short; the text
/// beside them wraps.
void keepNumbersWhole(QTextDocument& document, const presenters::PlanReport& report)
{
  constexpr double kRounding = 2.0;
  std::vector<const ReportTable*> tables;
  for (const ReportSection& section : report.sections)
    if (!section.table.rows.empty())
      tables.push_back(&section.table);
  std::size_t next = 0;
  for (QTextFrame* frame : document.rootFrame()->childFrames())
  {
    auto* shown = qobject_cast<QTextTable*>(frame);
    if (!shown || shown->format().headerRowCount() == 0 || next >= tables.size())
      continue;
    const ReportTable& table = *tables[next++];
    QVector<QTextLength> widths(shown->columns());
    for (int column = 0; column < shown->columns(); ++column)
    {
      double width = 0.0;
      for (int row = 1; row < shown->rows(); ++row)
      {
        const auto r = static_cast<std::size_t>(row - 1), c = static_cast<std::size_t>(column);
        if (r >= table.rows.size() || c >= table.rows[r].size() || !table.rows[r][c].isNumber)
          continue;
        const QTextTableCell place = shown->cellAt(row, column);
        width = std::max(width, widthOf(place));
        QTextBlockFormat format;
        format.setNonBreakableLines(true);
        QTextCursor(place.firstCursorPosition()).mergeBlockFormat(format);
      }
      if (width > 0.0)
        widths[column] = QTextLength(QTextLength::FixedLength,
                                     width + 2.0 * shown->format().cellPadding() + kRounding);
    }
    QTextTableFormat format = shown->format();
    format.setColumnWidthConstraints(widths);
    shown->setFormat(format);
  }
}

void fill(QTextDocument& document, const presenters::PlanReport& report)
{
  std::vector<const ReportPicture*> pictures;
  QString html =
      QString("<body style=\"color:%1\"><table width=\"100%\" cellspacing=\"0\" cellpadding=\"0\" "
              "border=\"0\"><tr><td valign=\"bottom\"><span style=\"font-size:20pt;font-weight:600;"
              "color:%2\">%3</span><br><span style=\"font-size:12pt\">%4</span></td>"
              "<td align=\"right\" valign=\"bottom\"><span style=\"font-size:16pt;font-weight:600;"
              "color:%2\">%5</span></td></tr></table><hr>")
          .arg(kInk, kAccent, escaped(report.title), escaped(report.name), escaped(report.side));
  html += factsHtml(report);
  for (const ReportSection& section : report.sections)
    html += sectionHtml(section, pictures);
  html += QString("<hr><p style=\"font-size:8pt;color:%1\">%2</p></body>")
              .arg(kDim, escaped(report.colophon));
  for (std::size_t n = 0; n < pictures.size(); ++n)
    document.addResource(QTextDocument::ImageResource, urlOf(n),
                         QImage::fromData(pictures[n]->png.data(),
                                          static_cast<int>(pictures[n]->png.size()), "PNG"));
  document.setHtml(html);
  keepNumbersWhole(document, report);
}

int pageOf(double height)
{
  return static_cast<int>(std::floor(height / kTextHeight));
}

// Of one that fits on a page.
bool isParted(const QTextBlock& block)
{
  constexpr double kRounding = 0.5;
  const QRectF rect = block.document()->documentLayout()->blockBoundingRect(block);
  const QTextLayout& lines = *block.layout();
  if (lines.lineCount() == 0 || rect.height() > 0.5 * kTextHeight)
    return false;
  const auto lineBottom = lines.lineAt(lines.lineCount() - 1).rect().bottom();
  return pageOf(rect.top()) < pageOf(rect.top() + lineBottom - kRounding);
}

bool isInTable(const QTextBlock& block)
{
  return QTextCursor(block).currentTable() != nullptr;
}

// A heading stands with what follows it, and the lines of a paragraph together: of one on two pages
// Qt draws a line on either.
bool belongsOnNextPage(const QTextBlock& block)
{
  constexpr double kRoom = 30.0 * kMillimetre;
  if (isInTable(block))
    return false;
  if (isParted(block))
    return true;
  const QTextBlock next = block.next();
  if (block.blockFormat().headingLevel() == 0 || !next.isValid())
    return false;
  const QAbstractTextDocumentLayout& layout = *block.document()->documentLayout();
  const double top = layout.blockBoundingRect(block).top();
  const int page = pageOf(top);
  return top - page * kTextHeight > kTextHeight - kRoom ||
         pageOf(layout.blockBoundingRect(next).top()) > page ||
         (!isInTable(next) && isParted(next));
}

bool addBreaks(QTextDocument& document)
{
  QTextBlockFormat format;
  format.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
  bool any = false;
  for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
    if (block.blockFormat().pageBreakPolicy() == QTextFormat::PageBreak_Auto &&
        belongsOnNextPage(block))
    {
      QTextCursor(block).mergeBlockFormat(format);
      any = true;
    }
  // Else what follows the last break may have no lines yet: Qt lays out when it is idle.
  document.markContentsDirty(0, document.characterCount());
  document.documentLayout()->documentSize();
  return any;
}

void breakPages(QTextDocument& document)
{
  constexpr int kRounds = 4; // a break may move what comes before it by a little
  for (int n = 0; n < kRounds && addBreaks(document); ++n)
  {
  }
}

void drawFrame(QPainter& painter, const presenters::PlanReport& report, int page, int pages)
{
  QFont small(QGuiApplication::font().family());
  small.setPixelSize(11);
  painter.setFont(small);
  painter.setPen(QColor(kDim));
  const QRectF head(kMargin, 8.0 * kMillimetre, kTextWidth, 6.0 * kMillimetre);
  painter.drawText(head, Qt::AlignLeft | Qt::AlignBottom, words(report.stamp));
  painter.drawText(head, Qt::AlignRight | Qt::AlignBottom, words(report.title));
  const QRectF foot(kMargin, kPageHeight - 13.0 * kMillimetre, kTextWidth, 6.0 * kMillimetre);
  painter.drawText(foot, Qt::AlignRight | Qt::AlignTop, words(report.pageOf).arg(page).arg(pages));
  painter.drawText(foot, Qt::AlignLeft | Qt::AlignTop, "Petrous");
  painter.setPen(QPen(QColor("#b9c6d0"), 0.7));
  painter.drawLine(QPointF(kMargin, head.bottom() + 3.0),
                   QPointF(kMargin + kTextWidth, head.bottom() + 3.0));
}

/// Takes out the time of writing, which says when an operation was planned. Overwritten, so that
/// what follows stays where the file's table of contents says.
void blankCreationDate(QByteArray& pdf)
{
  const int from = pdf.indexOf("/CreationDate (");
  const int to = from < 0 ? -1 : pdf.indexOf(')', from);
  if (to > from)
    std::fill(pdf.begin() + from, pdf.begin() + to + 1, ' ');
}

} // namespace

std::string pdfOf(const presenters::PlanReport& report, const core::Progress& progress)
{
  const Application application;
  if (QFontDatabase().families().isEmpty())
    throw core::Error(core::Fault::Refused,
                      "a PDF needs a font, and this computer has none; install the package "
                      "fonts-dejavu-core, or write an .html file");
  progress.check("writing the report");
  QTextDocument document;
  QFont font(QGuiApplication::font().family());
  font.setPointSizeF(9.5);
  font.setHintingPreference(QFont::PreferNoHinting);
  document.setDefaultFont(font);
  document.setUseDesignMetrics(true);
  document.setDocumentMargin(0.0);
  fill(document, report);
  document.setPageSize({kTextWidth, kTextHeight});
  breakPages(document);

  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  {
    QPdfWriter writer(&buffer);
    writer.setPageLayout(QPageLayout(QPageSize(QPageSize::A4), QPageLayout::Portrait, QMarginsF()));
    writer.setResolution(kResolution);
    writer.setTitle(words(report.title));
    writer.setCreator("Petrous");
    QPainter painter(&writer);
    painter.setRenderHint(QPainter::LosslessImageRendering);
    painter.scale(kResolution / 96.0, kResolution / 96.0);
    const int pages = document.pageCount();
    for (int page = 0; page < pages; ++page)
    {
      progress.report(static_cast<double>(page) / pages, "writing the report");
      if (page > 0)
        writer.newPage();
      drawFrame(painter, report, page + 1, pages);
      painter.save();
      painter.translate(kMargin, kHead - page * kTextHeight);
      QAbstractTextDocumentLayout::PaintContext context;
      constexpr double kApart = 0.25; // what only touches the page is another one's
      context.clip = QRectF(0.0, page * kTextHeight + kApart, kTextWidth, kTextHeight - 2 * kApart);
      context.palette.setColor(QPalette::Text, QColor(kInk));
      painter.setClipRect(context.clip);
      document.documentLayout()->draw(&painter, context);
      painter.restore();
    }
  }
  blankCreationDate(bytes);
  return bytes.toStdString();
}

} // namespace petrous::report
