#include "LandmarksBox.h"

#include <algorithm>

#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QTableView>
#include <QVBoxLayout>

#include "Bind.h"
#include "LandmarkModel.h"
#include "Theme.h"

namespace petrous::workstation
{

LandmarksBox::LandmarksBox(presenters::RegistrationSession& session, QWidget* parent)
  : QWidget(parent)
  , m_session(session)
  , m_rows(new LandmarkModel(session, this))
  , m_table(new QTableView)
{
  m_table->setObjectName("landmarks");
  m_table->setAccessibleName(tr("Pairs of points"));
  m_table->setModel(m_rows);
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setSelectionMode(QAbstractItemView::SingleSelection);
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setDefaultSectionSize(22);
  m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  m_table->horizontalHeader()->setSectionResizeMode(LandmarkModel::Number,
                                                    QHeaderView::ResizeToContents);
  m_table->horizontalHeader()->setSectionResizeMode(LandmarkModel::Residual,
                                                    QHeaderView::ResizeToContents);
  m_table->setFixedHeight(112);
  m_point = button({}, "landmarkHere", {});
  m_remove = button(tr("Remove"), "removeLandmark", tr("The pair that is chosen"));
  m_fit = button(tr("Lay by points"), "fitLandmarks",
                 tr("Lays the MR so that the pairs fall on each other; three at least"));
  connect(m_point, &QPushButton::clicked, this, &LandmarksBox::pointAsked);
  connect(m_fit, &QPushButton::clicked, this, &LandmarksBox::fitAsked);
  connect(m_remove, &QPushButton::clicked, this,
          [this]
          {
            if (const auto chosen = m_table->currentIndex(); chosen.isValid())
              m_session.landmarks().remove(static_cast<std::size_t>(chosen.row()));
            emit changed();
          });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(m_table);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  for (QPushButton* each : {m_point, m_remove, m_fit})
    row->addWidget(each);
  layout->addLayout(row);
}

void LandmarksBox::refresh()
{
  // The chosen pair, or the one that came in its place, stays chosen.
  const int chosen = m_table->currentIndex().row();
  m_rows->refresh();
  if (chosen >= 0 && !m_table->currentIndex().isValid() && m_rows->rowCount() > 0)
    m_table->selectRow(std::min(chosen, m_rows->rowCount() - 1));
  m_point->setText(m_session.landmarks().waitsForMr()
                       ? tr("Point in MR (K)")
                       : tr("Point in %1 (K)").arg(words(m_session.primary())));
  m_point->setToolTip(tr("The crosshair marks a point of the %1, then the same point of the MR (K)")
                          .arg(words(m_session.primary())));
  m_remove->setEnabled(!m_session.landmarks().rows().empty());
  m_fit->setEnabled(m_session.landmarks().pairs() >= 3);
}

} // namespace petrous::workstation
