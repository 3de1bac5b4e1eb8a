#include "VideoController.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QMenu>
#include <QMetaObject>
#include <QTimer>

#include "Application.h"
#include "AttachmentsController.h"
#include "BackgroundWork.h"
#include "Commands.h"
#include "MenuAction.h"
#include "StillOverlay.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "VideoPanel.h"
#include "VideoPicture.h"
#include "WindowTexts.h"
#include "petrous/Library/Attachments.h"

namespace petrous::workstation
{

namespace
{

constexpr int kMostSteps = 4; // that wait: a key that is held does not run on

// Shares the pixels.
QImage imageOf(const video::Frame& frame)
{
  using Pixels = std::shared_ptr<const std::vector<std::uint8_t>>;
  if (!frame.pixels)
    return {};
  auto* kept = new Pixels(frame.pixels);
  return {frame.pixels->data(),
          frame.width,
          frame.height,
          3 * frame.width,
          QImage::Format_RGB888,
          [](void* pixels) { delete static_cast<Pixels*>(pixels); },
          static_cast<void*>(kept)};
}

std::string strokeNow(const scene::Case& value)
{
  const std::size_t position = value.dissection.history().position();
  const auto& strokes = value.dissection.strokes();
  return position < strokes.size() ? strokes[position]->object : std::string();
}

} // namespace

VideoController::VideoController(presenters::WorkstationModel& model, ThreeDView& view,
                                 AttachmentsController& attachments, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_view(view)
  , m_attachments(attachments)
  , m_editor(model)
  , m_work(std::make_unique<BackgroundWork>())
  , m_check(std::make_unique<BackgroundWork>())
  , m_menu(new QMenu(tr("Vide&o"), &window))
  , m_overlay(new StillOverlay(view))
  , m_mail(std::make_shared<Mail>())
{
  addActions();
  m_panel = new VideoPanel(model, m_editor,
                           {m_play, m_back, m_forth, m_loop, m_bookmark, m_pair, m_showView});
  connectPanel();
  m_editor.changed = [this] { refresh(); };
  m_editor.inBackground = [this](presenters::VideoEditor::Work work)
  {
    if (!work)
      return m_work->abandon();
    m_work->replace(
        [this, work = std::move(work)](const core::Progress& progress) -> BackgroundWork::Reply
        { return [this, apply = work(progress)] { follow(apply); }; });
  };
  m_editor.cameraFound = [this] { emit changed(); };
  connect(m_overlay, &StillOverlay::overChanged, this, &VideoController::refresh);
  refresh();
}

VideoController::~VideoController()
{
  m_player.reset();
  m_editor.changed = m_editor.cameraFound = {};
  m_editor.inBackground = {};
  m_panel->onCaseChanged = m_panel->onStateChanged = m_panel->onAttachmentsChanged = {};
}

void VideoController::addActions()
{
  m_play = make(m_menu, tr("&Play"), Qt::CTRL + Qt::Key_Space, tr("Plays the video, or pauses it"));
  m_back = make(m_menu, tr("Step &back"), Qt::CTRL + Qt::Key_Left, tr("To the frame before"));
  m_forth = make(m_menu, tr("Step &forward"), Qt::CTRL + Qt::Key_Right, tr("To the frame after"));
  m_play->setIconText(tr("Play"));
  m_back->setIconText(QString::fromUtf8("◀"));
  m_forth->setIconText(QString::fromUtf8("▶"));
  m_loop = make(m_menu, tr("&Loop"), Qt::SHIFT + Qt::Key_U,
                tr("Repeats the part between the two bookmarks that are chosen in the list"));
  m_loop->setIconText(tr("Loop"));
  m_loop->setCheckable(true);
  m_menu->addSeparator();
  m_bookmark = make(m_menu, tr("Set a book&mark"), Qt::Key_U,
                    tr("At the frame that is seen, tied to the last stroke"));
  m_bookmark->setIconText(tr("Bookmark"));
  m_previousBookmark = make(m_menu, tr("Pre&vious bookmark"), Qt::CTRL + Qt::Key_Up,
                            tr("With the bone as it was then"));
  m_nextBookmark = make(m_menu, tr("&Next bookmark"), Qt::CTRL + Qt::Key_Down,
                        tr("With the bone as it was then"));
  m_menu->addSeparator();
  m_pair = make(m_menu, tr("&Add the landmark"), Qt::CTRL + Qt::Key_U,
                tr("The crosshair marks the point of the patient that was clicked in the still"));
  m_pair->setIconText(tr("Add landmark"));
  m_showView = make(m_menu, tr("View from the &still"), Qt::CTRL + Qt::SHIFT + Qt::Key_U,
                    tr("The 3D view from where the still was taken, with the still over it"));
  m_showView->setIconText(tr("View from it"));

  const auto on = [this](QAction* action, auto what)
  { connect(action, &QAction::triggered, this, what); };
  on(m_play, [this] { player().play(!m_isPlaying); });
  on(m_back, [this] { step(-1); });
  on(m_forth, [this] { step(1); });
  on(m_loop, [this](bool isOn) { setLoop(isOn); });
  on(m_bookmark,
     [this]
     {
       std::string name;
       if (!attempt([&] { name = m_editor.addBookmark(); }))
         return;
       const std::size_t stroke = m_editor.strokeOf(scene::findBookmark(m_editor.notes(), name));
       emit statusMessage(stroke > 0
                              ? tr("“%1” is set, tied to stroke %2").arg(words(name)).arg(stroke)
                              : tr("“%1” is set, tied to no stroke: nothing is drilled, or it is "
                                   "not saved yet")
                                    .arg(words(name)));
     });
  on(m_previousBookmark, [this] { stepBookmark(-1); });
  on(m_nextBookmark, [this] { stepBookmark(1); });
  on(m_pair, [this] { addPair(); });
  on(m_showView, [this] { showView(true); });
}

void VideoController::connectPanel()
{
  m_panel->onCaseChanged = [this] { caseChanged(); };
  m_panel->onStateChanged = [this] { stateChanged(); };
  m_panel->onAttachmentsChanged = [this] { attachmentsChanged(); };
  const auto index = [](int row) { return static_cast<std::size_t>(std::max(row, 0)); };
  connect(m_panel, &VideoPanel::videoChosen, this,
          [this](const QString& name) { choose(bytes(name)); });
  connect(m_panel, &VideoPanel::attachAsked, this,
          [this]
          {
            m_awaited = m_editor.videos().size() + 1;
            if (!m_attachments.attach())
              m_awaited = 0;
          });
  connect(m_panel, &VideoPanel::seekAsked, this,
          [this](qint64 at) { player().seek(std::chrono::milliseconds(at)); });
  connect(m_panel, &VideoPanel::bookmarkActivated, this, [=](int at) { goToBookmark(index(at)); });
  connect(m_panel, &VideoPanel::bookmarkRenamed, this,
          [=](int at, const QString& name)
          {
            if (!attempt([&] { m_editor.renameBookmark(index(at), bytes(name)); }))
              m_panel->refreshAnew();
          });
  connect(m_panel, &VideoPanel::moveAsked, this,
          [=](int at) { attempt([&] { m_editor.moveBookmark(index(at)); }); });
  connect(m_panel, &VideoPanel::tieAsked, this,
          [=](int at) { attempt([&] { m_editor.tieBookmark(index(at)); }); });
  connect(m_panel, &VideoPanel::bookmarkRemovalAsked, this,
          [=](int at) { attempt([&] { m_editor.removeBookmark(index(at)); }); });
  connect(m_panel, &VideoPanel::pairRemovalAsked, this,
          [=](int at) { attempt([&] { m_editor.removePair(index(at)); }); });
  connect(m_panel, &VideoPanel::stillRemovalAsked, this,
          [this] { attempt([this] { m_editor.removeStill(); }); });
  connect(m_panel, &VideoPanel::angleSet, this,
          [this](double degrees)
          {
            attempt(
                [&] {
                  m_editor.setViewAngle(degrees > 0.0 ? std::optional<double>(degrees)
                                                      : std::nullopt);
                });
          });
  connect(m_panel, &VideoPanel::opacitySet, this,
          [this](double opacity) { attempt([&] { m_editor.setOpacity(opacity); }); });
  connect(m_panel, &VideoPanel::overlayAsked, this, &VideoController::showView);
  connect(&m_panel->picture(), &VideoPicture::pointed, this,
          [this](const Eigen::Vector2d& pixel)
          {
            if (!m_isPlaying)
              attempt([&] { m_editor.markStill(pixel); });
          });
}

video::VideoPlayer& VideoController::player()
{
  if (m_player)
    return *m_player;
  const auto here = [this](const std::function<void()>& what)
  { QMetaObject::invokeMethod(this, what, Qt::QueuedConnection); };
  video::VideoPlayer::Events events;
  // What comes of a video that was left is dropped.
  using Opening = video::VideoPlayer::Opening;
  const auto of = [this, here](Opening opening, const std::function<void()>& what)
  {
    here(
        [this, opening, what]
        {
          if (opening == m_opening)
            what();
        });
  };
  events.opened = [this, of](Opening opening, const video::VideoInfo& info)
  { of(opening, [this, info] { opened(info); }); };
  events.shown = [this, here, mail = m_mail](Opening opening, const video::Frame& frame)
  {
    const std::lock_guard<std::mutex> lock(mail->mutex);
    mail->frame = frame;
    mail->opening = opening;
    if (!std::exchange(mail->isPosted, true))
      here([this] { takeFrame(); });
  };
  events.playing = [this, of](Opening opening, bool on)
  {
    of(opening,
       [this, on]
       {
         m_isPlaying = on;
         refresh();
       });
  };
  events.gap = [this, of](Opening opening, const video::Gap& gap)
  { of(opening, [this, gap] { tellGap(gap); }); };
  events.failed = [this, of](Opening opening, const std::string& why)
  { of(opening, [this, why = words(why)] { failed(why); }); };
  m_player = std::make_unique<video::VideoPlayer>(std::move(events));
  return *m_player;
}

void VideoController::caseChanged()
{
  m_awaited = 0;
  m_stroke = m_model.hasCase() ? strokeNow(m_model.value()) : std::string();
  attachmentsChanged();
}

void VideoController::attachmentsChanged()
{
  const std::string before = m_editor.video();
  follow([this] { m_editor.refresh(); });
  if (!before.empty() && m_editor.video().empty())
    closeVideo();
  // One that was attached from here is shown here.
  const std::vector<std::string> all = m_editor.videos();
  if (m_awaited == 0 || all.size() != m_awaited)
    return;
  m_awaited = 0;
  QTimer::singleShot(0, this,
                     [this, name = all.back()]
                     {
                       emit panelWanted();
                       choose(name);
                       m_panel->say(tr("A video may show or name the patient. It stays here when "
                                       "the case is archived or sent, unless asked."));
                     });
}

// The bone is in another state: so is the video, where a bookmark is tied to it.
void VideoController::stateChanged()
{
  if (!m_model.hasCase())
    return;
  const std::string stroke = strokeNow(m_model.value());
  if (stroke == m_stroke)
    return;
  m_stroke = stroke;
  if (m_goesAlong || m_isPlaying || !m_editor.time())
    return;
  if (const auto here = m_editor.bookmarkHere())
    player().seek(video::Time(m_editor.notes().bookmarks[*here].time));
  m_panel->refresh();
}

void VideoController::choose(const std::string& name)
{
  closeVideo();
  if (name.empty() || !m_model.hasCase())
    return;
  attempt(
      [&]
      {
        const scene::Attachment& one = scene::findAttachment(m_model.value(), name);
        if (!one.object.empty() || !one.link.empty())
          if (const auto problem = library::attachmentProblem(m_model.library(), one);
              !problem.empty())
            throw core::InvalidParameter("the file of '" + name + "' is " + problem);
        m_editor.choose(name);
        const auto file = m_editor.file();
        m_isOpening = true;
        m_panel->setOpening(true);
        m_opening = player().open(file, name);
        if (!one.link.empty())
          checkLinked(one);
      });
}

// Another file may be as large; it is read while the video is shown.
void VideoController::checkLinked(const scene::Attachment& one)
{
  m_check->replace(
      [this, one, library = m_model.library(),
       opening = m_opening](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const std::string problem = library::attachmentChange(library, one, progress);
        return [this, problem, opening, name = one.name]
        {
          if (!problem.empty() && opening == m_opening)
            failed(phrase("the file of '" + name + "' is " + problem));
        };
      });
}

void VideoController::closeVideo()
{
  m_check->abandon();
  if (m_player)
    m_player->close();
  m_opening = 0;
  m_steps = 0;
  m_isOpening = false;
  m_isPlaying = false;
  m_frame = {};
  m_panel->setOpening(false);
  m_panel->say({});
  m_panel->picture().setFrame({});
  attempt([this] { m_editor.choose({}); });
}

void VideoController::opened(const video::VideoInfo& info)
{
  m_isOpening = false;
  m_panel->setOpening(false);
  m_panel->setDuration(info.duration.count() / 1000000);
  takeFrame();
}

void VideoController::failed(const QString& why)
{
  closeVideo();
  m_panel->say(sentence(why));
  emit statusMessage(sentence(why));
}

void VideoController::tellGap(const video::Gap& gap)
{
  const auto text = [](video::Time time) { return numberText(presenters::timeText(time.count())); };
  const QString line =
      gap.end
          ? tr("The file is damaged after %1; it goes on at %2")
                .arg(text(gap.begin), text(*gap.end))
          : tr("The file is damaged or not whole: its last picture is at %1").arg(text(gap.begin));
  m_panel->say(sentence(line));
  emit statusMessage(line);
}

void VideoController::step(int by)
{
  if (m_steps >= kMostSteps)
    return;
  ++m_steps;
  player().step(by);
}

void VideoController::takeFrame()
{
  std::optional<video::Frame> frame;
  {
    const std::lock_guard<std::mutex> lock(m_mail->mutex);
    m_mail->isPosted = false;
    if (m_isOpening) // it comes with `opened`
      return;
    frame.swap(m_mail->frame);
    if (m_mail->opening != m_opening)
      frame.reset();
  }
  if (!frame || m_editor.video().empty())
    return;
  m_steps = 0;
  m_frame = imageOf(*frame);
  m_panel->picture().setFrame(m_frame);
  m_panel->setPlace(frame->time.count());
  follow([&] { m_editor.showFrame({frame->width, frame->height}, frame->time.count()); });
}

void VideoController::goToBookmark(std::size_t bookmark)
{
  if (bookmark >= m_editor.notes().bookmarks.size())
    return;
  player().play(false);
  player().seek(video::Time(m_editor.notes().bookmarks[bookmark].time));
  const auto state = m_editor.stateOf(bookmark);
  if (!state || !goToState)
    return;
  m_goesAlong = true;
  guarded([&] { goToState(state->branch, state->stroke); },
          [this](const QString& why) { emit statusMessage(why); });
  m_goesAlong = false;
  m_stroke = strokeNow(m_model.value());
  m_panel->refresh();
}

void VideoController::stepBookmark(int by)
{
  const auto& all = m_editor.notes().bookmarks;
  if (!m_editor.time() || all.empty())
    return;
  const std::int64_t now = *m_editor.time();
  if (by > 0)
  {
    for (std::size_t n = 0; n < all.size(); ++n)
      if (all[n].time > now)
        return goToBookmark(n);
  }
  else
    for (std::size_t n = all.size(); n-- > 0;)
      if (all[n].time < now)
        return goToBookmark(n);
  emit statusMessage(by > 0 ? tr("No bookmark comes after this frame")
                            : tr("No bookmark comes before this frame"));
}

void VideoController::setLoop(bool on)
{
  const auto chosen = m_panel->chosenBookmarks();
  attempt(
      [&]
      {
        if (!on)
          return m_editor.clearLoop();
        if (chosen.size() != 2)
          throw core::InvalidParameter("choose the two bookmarks in the list between which it is "
                                       "repeated (Ctrl and a click)");
        m_editor.setLoop(chosen[0], chosen[1]);
      });
  const auto loop = m_editor.loop();
  if (!loop)
    player().setLoop(std::nullopt);
  else
  {
    player().setLoop(video::VideoPlayer::Loop{video::Time((*loop)[0]), video::Time((*loop)[1])});
    player().seek(video::Time((*loop)[0]));
    player().play(true);
  }
  refresh();
}

void VideoController::addPair()
{
  attempt([this] { m_editor.addPair(m_model.crosshair()); });
}

void VideoController::showView(bool on)
{
  m_showsStill = on;
  const auto* still = m_editor.still();
  if (on && still && still->camera)
    m_view.setCamera(*still->camera);
  refresh();
}

// Only edits of the case save it: seeing a frame does not.
void VideoController::refresh()
{
  const bool open = m_editor.time().has_value();
  const auto* still = m_editor.still();
  const QString why = tr("Choose a video in the panel Video first");
  for (QAction* action : {m_play, m_back, m_forth, m_bookmark})
    enable(*action, open, why);
  const bool hasBookmarks = open && !m_editor.notes().bookmarks.empty();
  for (QAction* action : {m_previousBookmark, m_nextBookmark})
    enable(*action, hasBookmarks, open ? tr("The video has no bookmarks") : why);
  enable(*m_loop, m_editor.notes().bookmarks.size() > 1 && open,
         tr("The video has no two bookmarks"));
  m_loop->setChecked(m_editor.loop().has_value());
  enable(*m_pair, m_editor.mark().has_value(), tr("Click the point in the still first"));
  enable(*m_showView, still && still->camera, tr("The still has too few landmarks"));
  m_play->setText(m_isPlaying ? tr("&Pause") : tr("&Play"));
  m_play->setIconText(m_isPlaying ? tr("Pause") : tr("Play"));
  const bool isShown = m_showsStill && still && still->camera && !m_isPlaying;
  m_overlay->setStill(isShown ? m_frame : QImage(),
                      isShown ? still->camera : std::optional<core::CameraPose>(),
                      still ? still->opacity : 0.5);
  m_panel->refresh();
  m_panel->setOver(m_overlay->isOver());
}

bool VideoController::attempt(const std::function<void()>& what)
{
  const std::uint64_t before = m_model.edits().last();
  QString why;
  guarded(what, [&why](const QString& fault) { why = fault; });
  m_panel->say(why.isEmpty() ? QString() : sentence(why));
  if (m_model.hasCase() && m_model.edits().last() != before)
    emit changed();
  return why.isEmpty();
}

void VideoController::follow(const std::function<void()>& what)
{
  guarded(what, [this](const QString& why) { m_panel->say(sentence(why)); });
}

} // namespace petrous::workstation
