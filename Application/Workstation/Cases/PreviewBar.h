#pragma once

#include <functional>
#include <memory>

#include <QProgressBar>

#include "BackgroundWork.h"

class QLabel;

namespace petrous::workstation
{

/// Progress of a picture that another thread makes for a dialog; hidden once it is there, or once
/// it is known that there is none.
class PreviewBar : public QProgressBar
{
  Q_OBJECT
public:
  /// `fault`: what says that there is no picture, and why.
  explicit PreviewBar(QLabel& fault, QWidget* parent = nullptr);
  ~PreviewBar() override; ///< stops the work

  /// `make` runs in the other thread, `show` with its result in this one.
  template <class Make, class Show>
  void start(Make make, Show show)
  {
    m_work->start(
        [this, make, show](const core::Progress& progress) -> BackgroundWork::Reply
        {
          using Preview = decltype(make(progress));
          const auto preview = std::make_shared<const Preview>(make(progress));
          return [this, preview, show]
          {
            hide();
            show(preview);
          };
        });
  }

private:
  std::unique_ptr<BackgroundWork> m_work;
};

} // namespace petrous::workstation
