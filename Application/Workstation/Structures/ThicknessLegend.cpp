#include "ThicknessLegend.h"

#include <QLinearGradient>
#include <QPainter>

#include "Language.h"
#include "WindowTexts.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Rendering/ThicknessColor.h"

namespace petrous::workstation
{

namespace
{
// Pixels.
constexpr int kEdge = 12;
constexpr int kWidth = 236;
constexpr int kHeight = 68;
constexpr int kMargin = 12;
constexpr int kBarTop = 28;
constexpr int kBarHeight = 12;
} // namespace

ThicknessLegend::ThicknessLegend(QWidget& view)
  : QWidget(&view)
{
  setObjectName("thicknessLegend");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setGeometry(kEdge, kEdge, kWidth, kHeight);
  hide();
}

void ThicknessLegend::setStructure(const QString& name, bool onMr)
{
  m_isOnMr = onMr;
  m_structure = name;
  setVisible(!name.isEmpty());
  update();
}

void ThicknessLegend::setProgress(double fraction)
{
  m_progress = fraction;
  update();
}

void ThicknessLegend::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(16, 19, 23, 190));
  painter.drawRoundedRect(rect(), 5.0, 5.0);
  const QRect bar(kMargin, kBarTop, kWidth - 2 * kMargin, kBarHeight);
  QLinearGradient scale(bar.topLeft(), bar.topRight());
  const auto& colors = rendering::kThicknessColors;
  for (std::size_t n = 0; n < colors.size(); ++n)
    scale.setColorAt(
        static_cast<double>(n) / static_cast<double>(colors.size() - 1),
        QColor::fromRgbF(double{colors[n][0]}, double{colors[n][1]}, double{colors[n][2]}));
  const bool isDone = m_progress >= 1.0;
  painter.fillRect(bar, isDone ? QBrush(scale) : QBrush(QColor(60, 66, 74)));
  if (!isDone)
    painter.fillRect(
        QRect(bar.topLeft(), QSize(static_cast<int>(m_progress * bar.width()), bar.height())),
        QColor("#d7dce2"));
  painter.setPen(QColor("#d7dce2"));
  painter.drawText(QRect(kMargin, 4, kWidth - 2 * kMargin, kBarTop - 6),
                   Qt::AlignLeft | Qt::AlignVCenter,
                   painter.fontMetrics().elidedText((!isDone    ? tr("Measuring over %1, F6 stops")
                                                     : m_isOnMr ? tr("Tissue over %1, mm")
                                                                : tr("Bone over %1, mm"))
                                                        .arg(m_structure),
                                                    Qt::ElideRight, kWidth - 2 * kMargin));
  if (!isDone)
    return;
  const int last = static_cast<int>(presenters::kFarthestThickness);
  for (int mm = 0; mm <= last; ++mm)
  {
    const int x = bar.left() + (bar.width() - 1) * mm / last;
    painter.drawLine(x, bar.bottom() - 2, x, bar.bottom() + 3);
    painter.drawText(QRect(x - 12, bar.bottom() + 4, 24, 18), Qt::AlignHCenter | Qt::AlignTop,
                     numberLocale().toString(mm));
  }
}

} // namespace petrous::workstation
