#include "StartPage.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace petrous::workstation
{

StartPage::StartPage(QWidget* parent)
  : QWidget(parent)
{
  auto* title = new QLabel(tr("Drop a folder of DICOM here, or choose File > Open DICOM…"));
  title->setObjectName("big");
  title->setAlignment(Qt::AlignCenter);
  auto* more = new QLabel(tr("A CT of the temporal bone becomes a case at once. NRRD, NIfTI and "
                             "MetaImage files work too.\nNothing leaves this computer."));
  more->setObjectName("dim");
  more->setAlignment(Qt::AlignCenter);

  auto* sample = new QPushButton(tr("Make the sample patient"));
  sample->setObjectName("primary");
  sample->setToolTip(tr("Computes an artificial right temporal bone (0.3 mm voxels) and opens it"));
  auto* folder = new QPushButton(tr("Open DICOM…"));
  auto* known = new QPushButton(tr("Open case…"));
  auto* archive = new QPushButton(tr("Restore…"));
  archive->setObjectName("restoreArchive");
  archive->setToolTip(tr("Brings the case of an archive (.petrous) to the library and opens it"));
  connect(archive, &QPushButton::clicked, this, &StartPage::restoreAsked);
  connect(sample, &QPushButton::clicked, this, &StartPage::sampleAsked);
  connect(folder, &QPushButton::clicked, this, &StartPage::openFolderAsked);
  connect(known, &QPushButton::clicked, this, &StartPage::openCaseAsked);

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(10);
  buttons->addStretch();
  buttons->addWidget(folder);
  buttons->addWidget(known);
  buttons->addWidget(archive);
  buttons->addWidget(sample);
  buttons->addStretch();
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(14);
  layout->addStretch(4);
  layout->addWidget(title);
  layout->addWidget(more);
  layout->addSpacing(10);
  layout->addLayout(buttons);
  layout->addStretch(5);
}

} // namespace petrous::workstation
