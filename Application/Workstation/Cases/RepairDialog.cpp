#include "RepairDialog.h"

#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "PreviewBar.h"
#include "SliceView.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/IntensityDisplay.h"

namespace petrous::workstation
{

namespace
{

QLabel* plain(const QString& text)
{
  auto* label = new QLabel(text);
  label->setTextFormat(Qt::PlainText);
  wrapWords(*label);
  return label;
}

QString findingsText(const std::vector<imaging::Finding>& findings)
{
  QStringList lines;
  for (const imaging::Finding& finding : findings)
  {
    QString line = QString::fromUtf8("• ") + phrase(finding.text);
    if (finding.errorMm > 0.0 && finding.text.find(" mm") == std::string::npos)
      line += RepairDialog::tr(" At stake: %1 mm.").arg(numberText(finding.errorMm, 1));
    lines += line;
  }
  return lines.join('\n');
}

} // namespace

RepairDialog::RepairDialog(const presenters::SourceContent& source, const QString& series,
                           QWidget* parent)
  : QDialog(parent)
  , m_remains(plain(tr("The pictures of it before and after are being made. In any case each slice "
                       "is put where its position says, by linear interpolation.")))
  , m_progress(new PreviewBar(*m_remains))
  , m_pictures(new QWidget)
{
  setObjectName("askRepair");
  setWindowTitle(tr("Repair the scan?"));
  resizeOnScreen(*this, {860, 680});
  auto* title = plain(tr("“%1” would mislead as it is. What is wrong:").arg(series));
  auto* findings = plain(findingsText(source.repair));
  findings->setObjectName("findings");
  m_remains->setObjectName("remains");
  auto* pictures = new QHBoxLayout(m_pictures);
  pictures->setContentsMargins(0, 0, 0, 0);
  m_pictures->setMinimumHeight(200);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  auto* repair = buttons->addButton(tr("&Repair and open"), QDialogButtonBox::AcceptRole);
  auto* another = buttons->addButton(tr("Open &another…"), QDialogButtonBox::ActionRole);
  repair->setObjectName("primary");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(another, &QPushButton::clicked, this,
          [this]
          {
            m_wantsAnother = true;
            reject();
          });
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addWidget(findings);
  layout->addWidget(m_pictures, 1);
  layout->addWidget(m_progress);
  layout->addWidget(m_remains);
  layout->addWidget(buttons);

  m_progress->start([file = source.path, selector = source.selector](const core::Progress& progress)
                    { return presenters::previewRepair(file, selector, progress); },
                    [this](const std::shared_ptr<const presenters::RepairPreview>& preview)
                    { show(*preview); });
}

void RepairDialog::show(const presenters::RepairPreview& preview)
{
  const auto display = presenters::displayOf(preview.before.value);
  const auto add = [&](const presenters::ScanPreview& scan, const char* name, const QString& title)
  {
    auto* view = new SliceView(preview.orientation);
    view->setObjectName(name);
    view->setAttribute(Qt::WA_TransparentForMouseEvents);
    view->setFocusPolicy(Qt::NoFocus);
    // The same place at the same scale in both.
    view->setPresenter(std::make_shared<const presenters::SlicePresenter>(scan.value),
                       preview.after.grid);
    view->setIntensityDisplay(display);
    view->setGreyWindow(display.bone);
    view->setCrosshair(preview.after.grid.center());
    view->setInterpolated(scan.value.ct.provenance.interpolated);
    auto* column = new QVBoxLayout;
    column->addWidget(plain(title));
    column->addWidget(view, 1);
    static_cast<QHBoxLayout*>(m_pictures->layout())->addLayout(column, 1);
  };
  add(preview.before, "before", tr("Before: the slices as they lie in the files"));
  add(preview.after, "after", tr("After: repaired"));

  QStringList remains{tr("What remains:")};
  for (const std::string& note : preview.notes)
    remains += QString::fromUtf8("• ") + phrase(note);
  const Eigen::Vector3d& spacing = preview.after.grid.spacing();
  remains += tr("• Linear interpolation smooths detail below about %1 mm.")
                 .arg(numberText(spacing.maxCoeff(), 2));
  if (!preview.after.value.ct.provenance.interpolated.empty())
    remains += tr("• Interpolated slices are orange here, and marked wherever the case is shown.");
  m_remains->setText(remains.join('\n'));
  m_isPictured = true;
}

} // namespace petrous::workstation
