#include "PreviewBar.h"

#include <cmath>

#include <QLabel>

#include "WindowTexts.h"

namespace petrous::workstation
{

PreviewBar::PreviewBar(QLabel& fault, QWidget* parent)
  : QProgressBar(parent)
  , m_work(std::make_unique<BackgroundWork>())
{
  setObjectName("previewProgress");
  setRange(0, 1000);
  connect(m_work.get(), &BackgroundWork::progressed, this,
          [this](double fraction, const QString&, const QString& left)
          {
            setFormat(withTimeLeft("%p%", left));
            setValue(static_cast<int>(std::lround(1000.0 * fraction)));
          });
  connect(m_work.get(), &BackgroundWork::failed, this,
          [this, &fault](const QString& why)
          {
            hide();
            fault.setText(tr("There is no picture of it: %1").arg(why));
          });
}

PreviewBar::~PreviewBar()
{
  m_work->drop();
}

} // namespace petrous::workstation
