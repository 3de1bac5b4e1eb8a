#pragma once

#include <set>
#include <string>
#include <vector>

#include <QObject>
#include <QString>

#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/CaseStamp.h"
#include "petrous/Presenters/WorkstationModel.h"

class QActionGroup;
class QImage;
class QLabel;

namespace petrous::workstation
{

class Banner;
class SliceColumn;
class ThreeDView;

/// "ear 7 · right · planned 2026-03-31".
QString stampText(const presenters::CaseStamp& stamp);

/// Writes on a picture, in its upper right corner; on one that is side by side, on both halves.
void drawStamp(QImage& picture, const QString& text, bool isSideBySide = false,
               presenters::Backdrop backdrop = presenters::Backdrop::Dark);

/// Writes over every view whose case it is and which side is operated on, and asks for the side
/// where the case does not say it.
class CaseStamps : public QObject
{
  Q_OBJECT
public:
  /// `sides`: checkable actions, each one's data its scene::Side.
  CaseStamps(presenters::WorkstationModel& model, ThreeDView& view, SliceColumn& slices,
             Banner& question, QActionGroup& sides, QObject* parent);

  void stateChanged();
  void caseOpened(); ///< asks, unless the case knows its side
  void caseClosed();

signals:
  void answered(); ///< the case is to be saved

protected:
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the slices

private:
  void setSide(scene::Side side);
  void putOff();
  void ask();
  void doubt(); ///< asks whether the side is right where the image speaks against it
  void placeInSlices();

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  Banner& m_question;
  QActionGroup& m_sides;
  std::vector<QLabel*> m_inSlices;
  scene::Side m_asked =
      scene::Side::Unknown;       ///< the side when the question was last shown or hidden
  std::set<std::string> m_putOff; ///< cases that were not told their side until the next start
};

} // namespace petrous::workstation
