<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en_GB">
<context>
    <name></name>
    <message>
        <source>Not held: {names}. Correct a picture soon after too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {common} pictures differ by more than 2°, most at {time}: {size}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No picture differs by more than 2°.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} pictures have an angle that had none.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose another folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}, other sign</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Three discs of the palm are needed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The column of the times is needed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At least one angle is needed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Flexion–extension</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb, knuckle sideways</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>flexion</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>extension</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>radial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ulnar</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>supination</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pronation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>less</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not judged: no limit was set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few to say, {count} readings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>agree within {limit}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>agree within {apart}, {count} readings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up to {apart} apart: do not mix</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angle}: Carpus lies between {low} and {high} of the reference. Not judged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} agree within {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} agrees within {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} do not.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} does not.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too few readings of {angles}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} do not agree within {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angles} does not agree within {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too few readings to say whether they agree within {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Judged against the {limit} that you set before.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No limit is set: Settings, “Agreement”. Set it before you compare.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A goniometer itself repeats within 4 to 5° by one rater.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One session of one person says nothing of others.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{first} and {last}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time shift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none needed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hand held still at each reading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reference later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{later}; curves match {match}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>curves match {match}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Alignment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>angles compared as they are</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>turned as one rigid body; {off} mm apart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of the reference; joined at Carpus’s pictures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sampling</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{rate} a second</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>readings: hand not still or not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pictures predicted, doubtful or lost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{left} of {all}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>and {count} more, in the table that is saved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grip</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Key pinch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Three-point pinch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tip pinch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Round the wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Round the palm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Figure of eight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Volume of the hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain at rest</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain when moving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>knuckle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>middle joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>end joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} finger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger}, {joint}, {movement}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bent</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>active</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>passive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of {most}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goniometer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Force</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Scores</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>less is better</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more is better</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not judged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no change beyond error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>improved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>worse</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{before} → {after} since {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>(error {size})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>right edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>upper edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lower edge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>top left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>top right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bottom left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bottom right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>top</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bottom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>middle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the board to the {place}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Into the dashed outline, then hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Into the dashed outline, its {side} nearer to the camera; then hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tilt the board: {side} nearer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearly half-way to upright, then hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring the board nearer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About 45 cm from the camera, then hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the board farther away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About 85 cm from the camera, then hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>That is enough</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Press “Work out”, or show more: it only gets better.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More light: the picture is too dark.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No board seen: show all of it, flat, in even light.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn it less: it is nearly edge-on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold still.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not sharp: hold still, or give it more light.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Taken. Now another place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>all four sides</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{side} missing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} sides</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{near}–{far} cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Places</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} fields</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{least} of {all} or more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tilts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{least} sides, over {tilt}°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Distance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>near and far</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sharpness</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sharp</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not sharp</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>edges below {most} px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Still</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>still</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>below {most} px/picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work out · show the board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work out · 1 picture to go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work out · {count} pictures to go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work out · more places and tilts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Work out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not good enough: lines land {error} px off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is changed. Glue the board onto something flat and stiff, give it light, and take the pictures again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth lies {apart} px beside the colours.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is changed. Switch the camera’s registration on: run “carpus doctor”, it says how.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines land within {error} pixels of where they are.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is calibrated. {depth}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{land} A hand of {hand} mm read {more} before; it is put right from now on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its depth was not checked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth reads right.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth read {share} % too long.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth read {share} % too short.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size} mm too long</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size} mm too short</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>good: below {limit} px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fair: below {limit} px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>poor: above {limit} px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lines land within</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Focal length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share} % off before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle of the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{away} px to the side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lens bends lines by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not known</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>known</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{bend} px at most</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>put right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few pictures with depth on the board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth scale</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>small; put right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Depth shift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>within the scale’s error</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Board flat in depth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>good: within {most} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>noisy: keep 50 to 80 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colour on depth</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{apart} px apart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>good: below {most} px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>registration is off</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 field empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} fields empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Edge of the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>keep the hand inside</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size}° less</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size}° more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist flexion of {angle}°, read before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand of {length} mm, read before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A simulated camera: kept apart, for practice with the check card; no real session uses it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This camera does not say its number, so nothing can be kept for it. “carpus calibrate-camera --output” writes a camera file that the settings can name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the one of {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the maker’s values</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept for this camera, number {serial}, instead of {before}. Sessions measured before keep their values and say so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera out: check it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera unusual: check it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check {days} days old</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This camera was out at its last check: lengths {share} % too long. Angles hold. Check once more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This camera was out at its last check: lengths {share} % too short. Angles hold. Check once more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This camera was out at its last check: angles {angle}° off. Check it once more, or calibrate it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles not sure: a check of this camera near this session was out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths not sure: a check of this camera near this session was out; angles hold.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not calibrated and not checked yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Never calibrated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrated {ago}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Never checked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>out of its limits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>otherwise than usual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>it measured right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checked {ago}: {found}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera {serial}: {calibrated} {checked}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check it again: it was calibrated since.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>today</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>yesterday</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{days} days ago</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This camera has not been checked yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Print the card, lay it under the camera, and look at it for 30 seconds.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the limits are {angle}° and {length} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angle}° and {length} mm off at most</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check of {day}: {off}; {limits}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrated since the last check.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{basis} Check it now: that check was with the values before.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera measures otherwise than usual.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Within the limits: check once more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The last check is {days} days old.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It measured right then.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera measures right.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is out: lengths and angles are wrong.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is out: angles are {angle}° off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is out: lengths are {share} % too long.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is out: lengths are {share} % too short.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is out: a length is {length} mm off.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles still hold.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All distances</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wedge 30°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Over the ridge 50°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Flat 90°</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>80 mm across</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>120 mm along</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>25 mm high</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All about {share} % long: the depth, or a card not printed at 100 %; its ruler says which.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All about {share} % short: the depth, or a card not printed at 100 %; its ruler says which.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrated {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not calibrated yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next check by {day}. {calibrated}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lay the card flat under the camera, all of it in the picture, about 60 cm away.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The card has moved: the seconds begin again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of 6 discs seen: all of the card in the picture, even light, its wedge upright.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All six discs are seen. Leave it lying.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Knuckle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spread</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>TAM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger}, {joint}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the palm’s plane</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lifted {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bent {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ulnar {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Radial {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Inwards {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Away {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Out {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Total active motion (TAM)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{row}, range</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus: discs and set-up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the discs go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Blue matt paper, 12 mm, on clean dry skin</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1. Wrist: middle of the back of the wrist, over the crease of the lifted hand.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2. Thumb base: on the bony edge, a thumb&apos;s width from the wrist disc.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3. Knuckles: on the back of the hand just behind each knuckle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole hand: also on the creases of every joint, and on the nails. Small fingers: 8 mm.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The left hand is the mirror image.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put them where they were last time. Never on wounds, dressings or fragile skin.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing else blue in the picture: no sleeve, pen, ring or nail.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>40 mm, if printed at 100 %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera, arm, light, picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1. Camera 70 to 80 cm above the table, straight down, tied with a cord. Plug it straight in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2. No sun on the hand; even light from the ceiling; no shadow of the camera&apos;s arm.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>3. The forearm rests and stays still. A towel under it lets the hand bend down over the edge.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>4. Clear the table of everything blue. Roll up a blue sleeve.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>5. Choose the patient, Enter. Lay the hand flat and still, Space takes the picture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>6. Click the discs in the order of the drawing; check the names of the whole hand.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>7. All checks green: Enter. Space records, Space stops and opens the review.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop at pain of 5 or more, at 2 more than before, at numbness, swelling or dizziness.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>70 to 80 cm,</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>at least 60 cm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>camera, straight down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>safety cord</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>forearm rests, still</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>plain table, nothing blue</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Help</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lock</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search for a patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Record, and stop and review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain score</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pause and go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hide or show the marks on the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole picture or hand area</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speeds or angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open and close the patient’s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One figure large, or all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next angle as big number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next finger as big number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One finger from the side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Answer about a blue spot: disc 1, or yes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Answer about a blue spot: spot 2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Answer about a blue spot: neither, or no</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Accept the marker found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Undo the last marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Larger loupe</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smaller loupe</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap two markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last time&apos;s picture larger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Index finger cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle finger cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ring finger cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Little finger cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play and stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Previous picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Previous repetition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next repetition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave a repetition out, or take it back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles, path, speeds, ZYZ in turn</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the repetition&apos;s edge back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the repetition&apos;s edge on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Less time of the curves, larger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>More time of the curves</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All of the curves</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point at the session before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Point at the next session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the session pointed at</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put a marker right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Previous picture to put right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next picture to put right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marker not to be seen here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take a step back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next doubtful picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look at the {marker}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another blue spot is here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Is it the {marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which blue spot is the {marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand lost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold the hand flat under the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too few markers seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the back of the hand to the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is seen does not fit: hold the hand flat for a moment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracking well</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {count} markers seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker} hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} finger hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Finger ends hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} markers hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the thumb side up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raise the hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the back of the fingers to the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All markers seen. End joints are not measured: they follow the middle joints.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All markers seen, every joint is measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what}: {remedy}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker} seen now and then</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} markers seen now and then</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arm moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lay the forearm back where it was</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another blue spot</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb base</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} knuckle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} middle joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} end joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} tip</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Index</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ring</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Little</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click the {marker}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the middle of the back of the wrist, in the small dimple.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At the root of the thumb, just past the hollow beside the wrist.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On the back of the hand, 3–5 mm behind the knuckle, towards the wrist.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the middle of the creases over the middle joint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In the middle of the creases over the end joint.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On the nail, in its middle.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Clear the view of the wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the little-finger side up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take all names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take {count} names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All {count} markers found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each finger’s line runs from the wrist to its tip. Drag a name to another disc to change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Are these names right?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 name is doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} names are doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look at: {markers}. Enter says yes to the one that is asked; drag a name to another disc to change it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Is this the {marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Yes, it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{named} of {asked} markers found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not found: {markers}. Take the other names with Enter, then click these.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{markers} and {count} more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swap the two</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correct names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take that spot</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>with the names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>after marker {number}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{done} of {asked} found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{done} of {asked}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera tilt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>flat and still</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {count}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>names wrong</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>one doubted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} not found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>within {size} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>still, flat</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>for {count} pictures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ready</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cannot start yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>each within {size} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{distance} or more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up to {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>usual {low}–{high} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{minutes} min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more than 99 h</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{hours} h</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number}st</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number}nd</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number}rd</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number}th</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One moment.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the dots</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the blue dots to the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Let your hand rest.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A short break.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Well done.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Just try it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>And back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There!</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There. Hold it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As far as is comfortable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Further</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A little further</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A few minutes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About a minute</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About half a minute</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A moment longer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>then: {task}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bend your hand down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lift your hand up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Slide your hand to the thumb side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Slide your hand to the little finger side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the thumb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the little finger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn your palm up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn your palm down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close your hand to a fist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bend your fingers to a hook</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hook</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spread your fingers wide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open your thumb wide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb wide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the cup, lift it a little, put it back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the cup</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move your fingers as you like</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move your fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move your hand as you like</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move your hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn your hand back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open your hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Straighten your fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close your fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Touch the next fingertip</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Come back to the middle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Try everything without a patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No session yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reference</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limit {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus shows {what}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus shows more {what}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hatched: within the limit you set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seconds after the first picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>number of the reading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean of both · one point each 0.2 s, {count} points</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean of both · one point each reading, {count} readings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing measured by hand yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>passive {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>active {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>by hand, active</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>by hand, passive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus, mean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>old result</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>new result</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>was {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles: largest error of three</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lengths: largest error of three</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>newest {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>usual, up to {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>calibrated</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Usual, adults {span}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Error band ±{gap}{limit}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean, ± sd between repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other set-up: not compared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>at least: hidden in part</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number} out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>α and γ are given where their sd stays below 30° ({share} of the time): near the neutral pose only β and α + γ are known.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Target {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bending</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spreading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>0° = palm down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>should stay within {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>thumb ←</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>thumb →</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fingers ↑</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up ↑</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fingers →</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From the side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No sessions of this exercise yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 session is left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} sessions are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions that are left out, or measured otherwise, are not compared: their rings say why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing to compare: {left_out}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One session does not make a course.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare after the next session of the same kind.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>at least {size}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>TAM has improved in {count} of {all} fingers since {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has improved by {size} since {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} has lost {size} since {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No change beyond measurement error since {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not judged: the joints were hidden in part.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is hidden does not count.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not judged: {why}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too few repetitions to compare</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{joint} of the {finger}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From {before} to {after}: more than the measurement error of {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From {before} to {after}: within the measurement error of {limit}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>at least {change}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: {change}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: no change beyond measurement error.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden in part, or too few</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>at least {change}, error {limit}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{change}, error {limit}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{day}: measured although doubtful. {findings}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>camera {step} cm further away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>camera {step} cm nearer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the forearm moved {distance}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{day}: {reasons}. Shown as a ring and left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} pairs of one session, against {kind}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus camera calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before ({day})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before (maker)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In words</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What this means for a hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Estimated from the change of the camera’s values, not measured on hands.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ext.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>flex.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>across</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Movement time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peak speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peak reached after</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length of the way</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Way / straight line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peaks of speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smoothness (SPARC)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Widest opening, thumb–index</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist at the grasp</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand span, thumb–little</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its pose coherent meanwhile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its pose known to 15° meanwhile</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Jump when seen again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All fingers as one movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tremor, 3 to 12 Hz (rms)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bend together, {one}–{other} (r)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lag of {other} after {one}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of {one} that {other} moves</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Widest span, {one}–{other}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nearest, {one}–{other}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Touches, {one}–{other}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too slow to judge</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden from the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Out in {time}, fastest {speed}, way {straight} of straight, opened {opening}, wrist {wrist}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The thumb touched {met} of {all} finger tips</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whether the thumb touched the finger tips was hidden from the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{words}; of {hidden} the camera did not see it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Out in {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Touches hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Touched {met} of {all}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reach and grasp</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb to the finger tips</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spans</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fingers together</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Further figures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of motion of the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>whole arcs over the same time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>dashed: hidden; hatched: lost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bending over time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle joint, of the thumb lift</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not graded</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>excellent</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fair</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>poor</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>spread</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Knuckle (MCP)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle (PIP)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End (DIP)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Total (TAM)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of other hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of usual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what}, {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change since {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lift of the thumb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>knuckles of {fingers}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>middle joints of {fingers}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>end joints of {fingers}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>spreading of {fingers}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>all fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limited by the camera’s view ({sign}: at least): {parts}. Hidden stretches do not count.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not seen: {joints}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Total active motion (TAM): the largest sum of a finger’s bending in one moment, all its joints seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No total active motion (TAM): no finger’s joints were all seen at once.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It is missing where a finger’s joints were never all seen at once.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>DIP not measured: TAM takes it as two thirds of PIP.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Share of the other hand’s TAM, else of the usual 260° (thumb 140°): excellent from 100 %, good above 75 %, fair above 50 %, else poor (ASSH).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle joints</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{what}: {fingers}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{sign}: the camera did not see the end of that movement.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the first session on {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change since {when} is not judged: {why}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What was hidden in part is not judged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} {size} better</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} {size} less</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Since {when}: {changes} (error {limit}).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>MCP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>IP</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not judged: {why}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bends {full}, lacks {missing}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>TAM of all fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spreading of all fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lift and spread of the thumb</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Session report, page 2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path of the wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>with the hand’s axes along it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>joint centres; dashed: disc hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ways of the finger tips</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) to the thumb, Z (orange) up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) from the thumb, Z (orange) up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Place, speed, turning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ZYZ angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>band: ± 1 sd; black: α + γ, with γ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean ± sd; at the right: {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Progress report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Therapist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 session: {ids}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} sessions: {ids}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Made by Carpus {version}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>measured by Carpus {versions}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{before} and {after} repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Entered by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>never joined with the figures above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fair comparison</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All sessions were set up alike.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Session report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>right-handed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>left-handed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>both-handed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Date</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Length</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers were put right by hand; the result as measured is kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of motion</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>grey: repetitions; band: ± 1 sd of the angle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>dashed: target</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles over time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>bending</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>turning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Today</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range today, last time and other hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range today</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>grey: usual in adults (AMA, AAOS)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How sure are these figures?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed, pain, note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Entered by hand, not measured by Carpus: {values}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Session {id}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>settings {digest}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>data {digest}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>recording {digest}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>calibrated to {size} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>smoothed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as measured live</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Today, mean ± sd</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Best</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Usual (adults)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} ways out and back; ranges over the whole recording</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 repetition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean of {count} repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>number {number} left out: {reason}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>number {number} left out: not seen well enough</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>one range over the whole recording; no repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>it is too short</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>what is trained was not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>less than 10° of movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>it never went there and back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>each was quicker than 0.4 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{seconds} s not seen and not counted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>limited by the camera&apos;s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>limited by view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angle} at most</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>under {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>as asked: the hand stays in line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more than asked: watch the exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not judged: no error limit is known</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No range could be measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No change beyond measurement error since {when}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} {size} better</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} {size} less</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>(error {limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Since {when}: {changes}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>zero is the neutral hand, palm down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles in the order deviation, flexion, pro/supination; {zero}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles in the order of the ISB: flexion, deviation, pro/supination; {zero}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fingers: zero is straight, below it bent back. Wrist: {zero}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fingers: zero is straight, below it bent back; TAM is bending less what is missing to straight. Wrist: {zero}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>zero is straight by the therapist’s goniometer: the hand started at {angles}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Method: {markers} markers, colour and depth camera, {distance} away.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The wrist’s angles are in the order of the ISB.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus measures the hand in the room: it is the wrist only while the forearm rests.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera not calibrated with a board.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera calibrated {day}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera calibrated {day}, {days} days before.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>± is the spread between repetitions; each angle itself is known to about {sd} where seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>± is the spread between repetitions, of fewer than 3 the tracker’s own sd of one value; each angle itself is known to about {sd} where seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>± is the tracker’s own sd of one value: there was no spread to give; each angle is known to about {sd}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated hand: nobody’s movement was measured.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured although doubtful: {findings}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This session is marked as not counting.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This recording was cut short and recovered.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}, by {who}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share} of {frames}; {dropped} missed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share} % of the time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{share} % of the repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {all} figures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At least (≥) or not seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{distance} (limit {limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Forearm moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{depth} under its disc (fit {residual})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist turns about</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{angle} at most (limit {limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers and camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>doubtful, see above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peak speed, mean ± sd</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smoothness (SPARC; 0 is smoothest)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Target</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain first / last (0–10)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain (0–10)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not asked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{pain} at {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody takes part yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose volunteers or staff, never patients, by “People…”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>These are simulated hands.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limits of a simulated hand are never put into force.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 person is measured twice.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} people are measured twice.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} more make it usable.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Until then progress and reports use the limits of before. {least} people are the least; 20 are better.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limits of {day} with {count} people are in force. “Use these limits” puts these in their place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“Use these limits” puts them into force in progress and reports. Reports already made keep theirs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{last}, {count} times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>due by {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>complete</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>more than 14 days later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>measure again: {reason}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>second due</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>too late: measure both again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>missing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What changes in reports, once complete</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What would change in today&apos;s reports</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking at the sessions of {done} of {count} patients…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody else has two sessions of this exercise that compare.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{changed} of {count} statements change. Reports already made keep theirs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{verdict}, as now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>simulated, does not count</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>set aside: {reason}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cannot be read</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>cut short</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What counts as a change</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured by this clinic: {exercise}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On {date} with {count} people in {sessions} sessions; 95 % intervals in brackets.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In force in progress and reports, in place of the limits above.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not in force: {count} people are the least.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>SEM {size}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} people, not in force</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Flexion, extension</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Flexion and extension, whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Radial, ulnar deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Deviation, whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Supination, pronation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Supination and pronation, whole arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of a finger’s knuckle, middle or end joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of a finger’s spreading</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of the thumb’s joints</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set: {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{movement} {goal} (mean {mean}; a gain can be told from {told})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Proposed from the last session:</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Proposed from the last {count} sessions:</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{exercise}, {count} times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{exercise}, {count} s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set “{name}”, {number} of {count}: {part}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist flexion–extension</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist side to side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Palm up – palm down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Free movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Full fist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hook fist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spread the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Thumb across the palm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Free movement of the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole hand · {count} markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some fingers · {count} markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist · {count} markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lift the back of the hand up, then let it drop as far as comfortable.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Slide the hand to the thumb side, then to the little-finger side. Keep it flat.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the palm up as far as the markers stay visible, then back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the wrist freely. All three angles are recorded; no repetitions are counted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close all fingers into a full fist, then open flat.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep the knuckles straight, bend only the end joints like a hook, then open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spread the fingers wide, then close them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Touch each fingertip with the thumb in turn, opening it wide in between.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reach, take the cup, lift it a little, put it back, return.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the fingers freely. All joint angles are recorded; no repetitions are counted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Palm flat on a smooth sheet, forearm strapped.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Elbow at the side, forearm free, palm down under the camera.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Forearm on the wedge, back of the hand towards the camera, fingers straight.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Palm flat on the table, fingers straight and closed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Forearm on the wedge, thumb side turned up a little, fingers relaxed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand at its place at the edge, a cup of 5 to 7 cm at 20 to 30 cm.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up, fingers straight.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At the end of a fist the middle and end joints go out of the camera&apos;s sight: repetitions are counted all the same, and those ranges are given as “at least”. To see more, turn the thumb side up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About half-way the middle joints go out of the camera&apos;s sight: repetitions are counted all the same, and their range is given as “at least”. To see more, raise the wrist or turn the thumb side up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Under the palm the thumb&apos;s tip goes out of the camera&apos;s sight: what is trained here is its lift away from the palm, which stays in view.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Radial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ulnar</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Flexion</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Extension</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Supination</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pronation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{movement} deficit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>lacks {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Radial deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ulnar deviation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Palm down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bending arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turning arc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Right hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Both hands</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Both</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Right hand affected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left hand affected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Both hands affected</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose in the list who is measured and start here; the practice patient is simulated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose where the pictures come from, then go on here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the picture when the hand lies flat and every disc is to be seen.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click the blue discs in the picture, each as it is asked for above.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every disc has its name and every check is good: start here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The joints are followed already; the space bar starts the recording.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Let the hand move a few times; the space bar then stores it all.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>These are the results; the key X leaves out the repetition you are at.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make the report of this session here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the report as a PDF; only the made-up name is on it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>That was a whole session; the arrow at the top left leads back, at last to the patients.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no change</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the other hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>another exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fewer than 3 repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a simulated hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>marked as not counting</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>measured although the markers were doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the camera was at another distance</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>another start angle was given</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the forearm moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the recording was cut short</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden in part</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>angles in another order</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A recording counts once, by its newest result: 1 earlier result is left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A recording counts once, by its newest result: {count} earlier results are left out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“Error” is the smallest real change (MDC95), measured by this clinic on {date} with {count} people; where it has none of its own, experts’ choice for Carpus. For the same protocol, side and set-up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“Error” is the smallest difference called a change: experts’ choice for Carpus, not published figures; of an arc, which has two ends, √2 as much. For the same protocol, side and set-up, until the clinic has measured its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the same</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size} more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{size} less</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{difference} since the first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{difference}, within error ({limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{difference}, beyond error ({limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{difference}: within measurement error ({limit})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{difference}: beyond measurement error ({limit})</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>AgreementChart</name>
    <message>
        <source>Difference of the two measurements</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>AgreementScreen</name>
    <message>
        <source>Other &amp;reference…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Columns…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save tables and plots…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the comparison is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Differences</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Curves</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Per angle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus less the reference; in brackets 95 % intervals, repeated values allowed for</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The limit is a choice, not a proof: change it in Settings, before comparing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bringing the two together…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare this session with another measurement.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the same movement: markers, angles, goniometer readings, or another session.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a &amp;reference…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Comparing with {name}…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The session itself is never changed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How they were brought together</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not used</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>AgreementTable</name>
    <message>
        <source>Angle</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mean difference</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Limits of agreement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>RMSE</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ICC(2,1)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Curve match</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In words</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BackingUp</name>
    <message>
        <source>Plug the disk for back-ups in, and back up.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder for back-ups, on another disk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not chosen yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not there now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{free} GB free</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no back-up yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every session is in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 session is not in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} sessions are not in it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The last back-up is {days} days old.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{when} · {n} sessions, {size} GB · read back and compared: all equal</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reminder after {days} days.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder that holds the back-ups</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Restore the back-up of {when}? {come} sessions come, {change} change, {go} go.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is here now is backed up first, and its folder is kept beside the new one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus closes when it is done. Start it again then.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Restore it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave it as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BackupCard</name>
    <message>
        <source>Back-up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Everything of the data folder: patients, sessions, pictures, log. Works while you measure.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Back up now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Restore…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>then read back and compared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>shows first what changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each day at 12:00</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At 18:00</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only when told</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder for back-ups</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By itself</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the last 14, and one of each month for 2 years</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Bar</name>
    <message>
        <source>Test and retest</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check card</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Progress</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated hand: this is not {name}, and does not count.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This session does not count.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured although doubtful: {findings}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Saved {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recording {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracking again {percent}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far it is, and Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New result: choose</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} new results: choose</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Old and new over each other</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} pictures/s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{words}, {lost} lost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{time} of disk left</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BoardBeginning</name>
    <message>
        <source>Chessboard</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ChArUco: may be partly hidden, takes longer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Print the board…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The ruler on the print measures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera, to practise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Five minutes: how the lens sees, how far off the depth is, and whether depth lies on colour. Do it once for each camera, after a knock, and when the check card says so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrate the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1  Print the board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Print at 100 % (“actual size”) on plain paper and glue it flat onto something stiff, such as glass or a thick board. Then measure the ruler under it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>2  Show it to the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Even light, no reflections. The screen says where to hold the board; pictures are taken by themselves when it is still, sharp and in a new place. Nothing is changed before you say so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No picture of the board is stored.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A simulated board before a simulated camera, both clearly marked; kept apart from real ones.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It is plugged in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No camera is plugged in.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin · plug the camera in</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BoardResultView</name>
    <message>
        <source>Take &amp;again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One page…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use this calibration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where lines land, enlarged 50 times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next: 30 seconds with the check card show it on known angles.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before ({day})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before (maker)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In words</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What this means for a hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Estimated from the change of the camera’s values, not measured on hands.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BoardShowing</name>
    <message>
        <source>Undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>take this picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures are taken by themselves when the board is still, sharp and in a new place.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the board has been</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is being opened.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One moment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No picture yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold the board in the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All of it, flat towards the camera, about 60 cm away.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No pictures from the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} pictures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Working it out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A few seconds; put the board down.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {all}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera and board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold it here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold it here, {side} nearer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} of {all} corners found</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>BubbleView</name>
    <message>
        <source>&amp;Next</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave the guide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First session · {number} of {count}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Done</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ByHand</name>
    <message>
        <source>Leave without saving?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Values are written that are not kept yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save them, or let them go.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back to the form</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Let them go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unusual: check, or keep it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look at the numbers once more before they are kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep as written</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ByHandScreen</name>
    <message>
        <source>Day of measuring</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Other measures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save values</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured by hand, {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By {initials}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Empty means not measured. Nothing here changes a figure of Carpus.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Other measures…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>By hand and by Carpus are never joined</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Neither averaged nor subtracted. A change is judged within one way of measuring.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Written and not kept yet: also the other hand or another day.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Kept with initials and time; every later change stays readable.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Calibrating</name>
    <message>
        <source>Save the board to print</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save one page</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show it some more, tilted more and nearer: {why}.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CameraCard</name>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A printed board shows how the camera sees and how far off its depth is; a printed card shows in 30 seconds whether it still measures right. Both can be tried with a simulated camera.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Chec&amp;k card…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CameraScreen</name>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recording</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A simulated hand does the exercise, to try things out. It is marked as simulated.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a &amp;file…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a fol&amp;der…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Progress</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where do the pictures come from?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Before you go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera above the hand, 60 cm or more away, looking straight down. No sun on the markers.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The depth camera over the hand.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plug it straight into the computer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A stored recording: a file of Carpus or of the camera (.oni, .db3), or a folder of pictures.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the recording</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start the simulation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No camera yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a recording first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Opening…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recordings (*.oni *.db3 *.bag *.carpusraw);;All files (*)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a folder of pictures</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CardScreen</name>
    <message>
        <source>The camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Print &amp;card…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One page…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the check is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Usual: mean of the first 7 checks after a calibration, + 3 sd. Limits are fixed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checking</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its ruler must be 100 mm long, the wedge glued onto the dashed field. Nothing is held.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Each check is a point here: a camera that drifts is seen before it is out.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check once more</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check now, 30 seconds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Check · plug the camera in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The camera is being opened.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{seconds} s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>On the card</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>If it is out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>card flat, 60 cm away, its ruler 100 mm long</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrate the camera again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>with the board, five minutes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Still out: do not measure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>sessions near this check say that they are not sure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated camera and card</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CheckRow</name>
    <message>
        <source>good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>to be looked at</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>missing</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Checking</name>
    <message>
        <source>Save the card to print</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save one page</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not with a board</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Calibrated</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checks</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ChooseSheet</name>
    <message>
        <source>Choice</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave it as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ColumnsSheet</name>
    <message>
        <source>As the file says</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Degrees</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Radians</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which marker is which?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which column is which?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of {file}: at least three discs of the palm. Leave the others open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of {file}: the time, and at least one angle. Leave the others open.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other sign</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Comparing</name>
    <message>
        <source>the session of {when}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Other measurements ({endings})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another measurement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save tables and plots into a folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} files were written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder: {folder}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files: {names}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ControlCharts</name>
    <message>
        <source>Checks of this camera</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CorrectScreen</name>
    <message>
        <source>Track again although &amp;doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next doubtful picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not to be seen here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track again from here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back to the review (Esc)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>move a name</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not to be seen here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>next doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At this picture: distance to its place</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading the picture…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Doubtful at {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Picture at {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put “{marker}” on its disc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which name is wrong?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag a name in the picture, or choose it below and click its disc.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No pictures stored: the {count} blue spots of this moment. Drag a name to its spot.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Changed here: {markers}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Track again from {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing changed yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look at the names at {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“{one}” and “{other}” look exchanged</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>So the angles would be wrong from there on. Let the two change places?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change the two names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“{marker}” cannot be there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It lies {size} mm from where the other discs let it be. It may be another disc, or no disc.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the last step back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show that picture</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CorrectionPicture</name>
    <message>
        <source>Picture to put markers right on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker}, so far</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker}, hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker}?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CourseRun</name>
    <message>
        <source>Rest {time}; Space begins at once.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>CurveView</name>
    <message>
        <source>Curves of the session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wheel: zoom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>DegreesField</name>
    <message>
        <source>Up to {most}°, or empty</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>EncryptSheet</name>
    <message>
        <source>&amp;PIN until now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;New PIN, ten signs or more; four words are good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same &amp;again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Encrypt what is stored</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Protects patients, sessions, pictures and new back-ups from whoever takes the computer or a disk. Does not protect: a recording until it is stored, names of files (pseudonym, exercise, date), the log, exports, back-ups made before, and everything while Carpus is open.

The PIN is asked for at every start. Without it and without the recovery code that is shown next, the data are lost for good, and nobody can help. Make a back-up first.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Encrypt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make it readable again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every file is decrypted. From then on whoever has the disk can read it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Decrypt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Encrypting, {percent} %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Decrypting, {percent} %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Everything that is stored is encrypted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Recovery code: it opens everything when the PIN is forgotten. Write it down now and keep it away from this computer; it is not shown again.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>I have written it down</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files can be carried away and tried: ten signs or more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The two are not the same.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>EncryptionCard</name>
    <message>
        <source>Encryption</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not everything is readable again yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Some files are still encrypted. The PIN stays until they are not.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Try again…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Encrypted on the disk</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patients, sessions and pictures can only be read with the PIN, also from back-ups made since. Not protected: a recording until it is stored, names of files (pseudonym, exercise, date), the log, exports and reports, and everything while Carpus is open. PIN and recovery code lost, the data are lost for good.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make it readable again…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off: files are readable</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whoever has this computer’s account or its disk can read patients and sessions. Encryption makes them readable with a PIN only, which must be typed at every start.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Encrypt…</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>EraseSheet</name>
    <message>
        <source>Erase for good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Archive instead</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This goes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This stays</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This cannot be undone</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leaves all lists and counts nowhere; everything can be brought back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Erase this session for good?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Erase this patient for good?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To erase, type “{name}” here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} files</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The patient’s entry, real name and notes, and {count} sessions with all angles, pictures and</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> notes ({files}, {size} MB).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles, pictures, notes and pain scores of this session ({files}, {size} MB).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} exports</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} reports</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The {made} that Carpus made from it go too.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> and </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The other session.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The other {count} sessions.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back-ups up to {day} and files copied elsewhere: Carpus cannot reach them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files copied elsewhere: Carpus cannot reach them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exports and reports that were changed since: {n}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exports and reports that are not where Carpus put them: {n}, look for them yourself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The log keeps that it was erased, no name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody can bring it back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>({years} years, as set in Settings)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Your records must be kept until {day} {years}: erasing comes before that day.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ExerciseScreen</name>
    <message>
        <source>Sets of exercises…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use as targets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Inferred</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>End joints of the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Adult</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Child</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Yes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next: the camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which exercise?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand that is measured</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The patient’s view is for</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep the pictures too</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Needed to see and correct markers later: {size} MB a minute, room for {time}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Target, {movement}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which hand is measured?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ExportSheet</name>
    <message>
        <source>Tables (CSV): angles, joints, markers, events, measures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measures with their origin (JSON)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers for motion capture programs (C3D)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers for OpenSim (TRC)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles for OpenSim (MOT)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Data set for research (BIDS-Motion)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The session itself, for another Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export this session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files that are there are never overwritten.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody can be found by it: new random name, days counted, no notes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How far the export is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose the folder…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare with a &amp;reference…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>FieldMap</name>
    <message>
        <source>Where the board has been</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>FingerCurves</name>
    <message>
        <source>Joint angles of the last ten seconds, by finger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>follows the middle joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>follows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last 10 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bending</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spreading</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HandChart</name>
    <message>
        <source>{name} over the days</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HandDrawing</name>
    <message>
        <source>Hand from above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Right hand,
from above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left hand,
from above</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HandForm</name>
    <message>
        <source>Active</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Passive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>last time</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HandMap</name>
    <message>
        <source>Markers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>partly seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden, predicted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>F2 next joint · F3 next finger
Shift+F8 from the side</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>HelpScreen</name>
    <message>
        <source>Back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cards to print…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show me around</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Guide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the cards</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Journey</name>
    <message>
        <source>Simulated camera: nothing here is of a real one.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LandingMap</name>
    <message>
        <source>Where lines land</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hatched: no pictures there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>0.5 px</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LastPicture</name>
    <message>
        <source>Last time, {day}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LicencesWindow</name>
    <message>
        <source>Parts and their licences</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ListHeader</name>
    <message>
        <source>Patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Last session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LiveCurves</name>
    <message>
        <source>Curves of the last ten seconds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turning</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Moving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Target {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>10 s ago</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>should stay within {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>0° = palm down; stay within {angle}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>0° = palm down</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LiveScreen</name>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pause</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speeds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patient’s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The recording plays from its first picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Waiting for a picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Storing…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain {score} noted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Plug the camera in again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close the patient’s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the patient’s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play and record</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Record</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop and go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Space · pedal</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Side · {finger}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LockCard</name>
    <message>
        <source>Lock</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A PIN hides names and pictures from those who pass by. Alone it protects no file: for that there is encryption, below, and that of the computer’s own disk.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After 5 min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After 10 min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>30 min</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Never</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lock by itself</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>locks now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change PIN…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set a PIN…</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LockSheet</name>
    <message>
        <source>Locked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is lost. The open session is stored.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is lost.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Names, pictures and figures are hidden.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is stored here is encrypted.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Locked by itself at {time}, after {minutes} minutes without a key.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Locked at {time}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not this PIN. 1 more try, then a pause of 1 minute.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not this PIN. {left} more tries, then a pause of 1 minute.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too many tries. The next one in {seconds} s.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIN forgotten? F1 says what can be done.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Type the recovery code instead, which was shown when the encryption was switched on. Without PIN and code nobody can read what is stored.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whoever looks after this computer takes the file pin.json out of the data folder and starts Carpus again: nothing is lost. A PIN hides; it does not protect the files.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Locking</name>
    <message>
        <source>The PIN until now is another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Too many tries. The next one in {seconds} s.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It opens what is encrypted: ten signs or more, or decrypt it first.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>LogSheet</name>
    <message>
        <source>Log</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Only ever added to. In the file patients and sessions are numbers: names are put to them here, as long as they are in the list.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>When</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Who</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of whom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Details</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The log was changed at or before line {line}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole: {n} lines, none changed.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MarkerPicture</name>
    <message>
        <source>Picture to click the markers on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is this?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marker found · {width} px wide</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Found · {width} px</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MarkerRow</name>
    <message>
        <source>{size} mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>hidden</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{now}, was {size} mm</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MarkersScreen</name>
    <message>
        <source>Wrist cannot lie straight…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start although &amp;doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take all names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click all again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>accept</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Backspace</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>move 1 px</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>zoom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tab</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>next marker</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>larger last picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Waiting for a picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No blue marker here. Click nearer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Already the {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This marker is the {name} already. Click another one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Starts at {angles} (given)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Drag a name to its disc. Names that change places swap.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lay the hand flat and still</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Palm down, fingers as straight as they go, forearm in line. Then take the picture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Marker {number} of {asked}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checking…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Good so far</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 marker to go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} markers to go</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start measuring · {left}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Checking the markers…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The hand lies flat and still, palm down. Fingers that stay bent are fine.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looking for the markers…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No blue disc in the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No blue disc is to be seen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Are the discs on, and the hand under the camera? More light helps; dark blue cloth is no disc.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Names to confirm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All markers found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ready to measure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hold the hand in this position until the measuring begins.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Correct names</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click these again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The names stay as they are until you change one.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MeasureRow</name>
    <message>
        <source>where</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}: where it was taken</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{side} {value}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>taken back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Entered before for this day:</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean {value}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>MeasuringFlow</name>
    <message>
        <source>Recording paused by itself at {time}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{time} and {count} full repetitions are stored.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose another source</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To the patients</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The recording has only just begun.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It goes on while you choose, and everything is kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on measuring, or stop it already?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop, save and close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A recording is running.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Everything measured up to now is kept, whatever you choose.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on measuring, or stop: the session is saved and Carpus closes.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>NoteSheet</name>
    <message>
        <source>What happened? No names.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep note</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note at this moment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopped for pain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Strap loosened</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rest</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Helped by hand</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>NoticeStrip</name>
    <message>
        <source>Later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>NumberCard</name>
    <message>
        <source>{finger}, total active motion (TAM)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{joint}, {side}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>doubtful, not counted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>no value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>predicted</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>follows the middle joint</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repetition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>of {asked}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Best today</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Target {angle}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PainSheet</name>
    <message>
        <source>Pain now, 0 (none) to 10 (worst)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>At 5 or more, or 2 more than before: stop the exercise. Keys: 0 to 9; 1 and 0 for 10.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PathView</name>
    <message>
        <source>Path of the wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>thumb ←</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>thumb →</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fingers ↑</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From above</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>up ↑</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>fingers →</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From the side</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From the fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>15 mm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path of the wrist, last 10 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{span} × {span} mm, fixed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> · cross: where the wrist turns; it must stay in the ring</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>arm moved ({distance})</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>forearm still ({distance})</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PatientCardView</name>
    <message>
        <source>Start session, same set-up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Edit…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Change…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Progress</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All &amp;sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated: nothing counts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Markers as on {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No session yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Note of {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start practice</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start from a file · no camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Start first session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A simulated patient moves in front of a simulated camera. Try every step without a patient.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put the markers on, then start.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{ordinal} session</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PatientForm</name>
    <message>
        <source>&amp;Another</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Right</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not known</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close without saving</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A made-up name that can be spoken aloud. No real name, no initials, no date of birth.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Name in Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Real name, if wanted (stays in this list, never in a session or report)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Affected hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Writes with</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>N&amp;ote (no diagnosis, no names)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Archi&amp;ve or delete…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Add patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A name has up to {count} letters: what goes beyond is not taken.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the patient a name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“{name}” is taken. Choose another name.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PatientList</name>
    <message>
        <source>Patients</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PatientView</name>
    <message>
        <source>{done} of {asked}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PatientsScreen</name>
    <message>
        <source>Name or exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ctrl+F</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ctrl+N</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patients</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>choose</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>start</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>help</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Practice patient</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PeopleSheet</name>
    <message>
        <source>Who takes part?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Volunteers or staff whose hands do not change, never patients. Add them under Patients, by a pseudonym such as P01. Each is measured twice or more within 14 days, all discs taken off and put on anew.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>These take part</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody is in the list yet.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PictureView</name>
    <message>
        <source>Camera picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Hand area ×{scale}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole picture</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>PinSheet</name>
    <message>
        <source>&amp;PIN until now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep this PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Take the PIN away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Four signs or more, digits or letters. It hides names and pictures from those who pass by; files are readable for whoever has this computer’s account or disk.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;New PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same &amp;again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change the PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Set a PIN</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A PIN has four signs or more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The two are not the same.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Player</name>
    <message>
        <source>Previous picture (←)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play (Space)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Next picture (→)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is drawn</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is drawn of the movement (V)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Angles</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Place, speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ZYZ</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>play</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>repetition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{time} of {whole}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Play</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{factor}× speed</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Printing</name>
    <message>
        <source>Export into a folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save table</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 file was written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} files were written.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Folder: {folder}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Files: {names}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ProgressChart</name>
    <message>
        <source>Range over the sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name} {value}, {count} repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera {distance} cm away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click opens the session</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ProgressScreen</name>
    <message>
        <source>Progress report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save picture…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save table…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Values by &amp;hand…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exercise and hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is followed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 session, {last}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} sessions, {first} – {last}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{first} and {last}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{before} and {after} repetitions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Peak speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>error not yet known</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measured by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fair comparison</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All sessions were set up alike.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulated sessions are among them.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ReasonSheet</name>
    <message>
        <source>It stays in the recording and on the curves, but counts no longer. The report says so.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>helped by hand</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>trial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep it in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave repetition {number} out?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RecordLists</name>
    <message>
        <source>Nothing is due: no patient’s last session is so old.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Say first how many years records must be kept.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Their last session is more than {n} years ago. Nothing goes by itself.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} sessions, the last on {last}; had to be kept until {until}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is due</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>session of {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>archived on {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>In no list and no count. Everything can be brought back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Archive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The archive is empty.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>by command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>opened</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>recorded</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>added</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>exported</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>report saved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>set aside</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>taken back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>moved</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>exercise changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>tracked again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>recovered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>archived</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>brought back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>erasing begun</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>erased</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>backed up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>back-up compared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>restored</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>locked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>unlocked</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIN refused</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PIN changed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>log read</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>values by hand entered</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>encryption switched on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>encryption switched off</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RecordingPill</name>
    <message>
        <source>Recording {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Paused at {time}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RecordsCard</name>
    <message>
        <source>Records</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How long records must be kept after the last session: your law says it, Carpus does not know.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{n} years</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is d&amp;ue…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Archive…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Log…</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RecordsSheet</name>
    <message>
        <source>Done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Archive</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Erase…</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ReferenceSheet</name>
    <message>
        <source>Compare this session with what?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same movement, measured by something else at the same time: markers (C3D, TRC), angles (MOT, STO, or a CSV table), a list of goniometer readings (CSV), or another result.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose a &amp;file…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Or another session of this &amp;patient</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare with this &amp;session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ReportScreen</name>
    <message>
        <source>Save PDF…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the PDF</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preview of the report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One page of A4</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} pages of A4</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{pages}, readable in grey. It carries the made-up name, never a real one.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not saved yet</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Saved</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ResultChoice</name>
    <message>
        <source>Results of this recording</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{number} · {day}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{result}, counts</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ResultsSheet</name>
    <message>
        <source>How far the tracking is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Keep the old one</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Use the new result</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tracking again: {percent} %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on working meanwhile. Nothing replaces the old result until you choose; Stop keeps it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go on working</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading both results…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Decide later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use the new result?</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>RetestScreen</name>
    <message>
        <source>Exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;People…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save table…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Use these limits…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading the sessions…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nobody is due</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure {name}, second time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>People</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>all discs taken off and put on anew before each time, within 14 days</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Person</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Second time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Apart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>State</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{days} d</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Smallest real change, so far</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is nothing yet: two people measured twice give the first figures.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>from {people} people, {sessions} sessions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>from {people} people, {sessions} sessions, {raters} raters</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>from {people} people, {sessions} sessions, 1 rater</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Movement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>SEM</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Real change (MDC95), 95 % interval</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Today</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New limit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Grey = not yet usable. Reports then say whose limits they are, with date and number of people. A new camera, exercise or way of mounting needs its own study.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Retesting</name>
    <message>
        <source>Use these limits for {exercise}, from {count} people?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions stay as they are; reports already made keep their limits.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From now on progress and reports judge by them, and name date and number of people.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use these limits</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave it as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save table</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ReviewScreen</name>
    <message>
        <source>All fingers</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Range of motion</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Do not count</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The session stays, and is compared with none. Can be taken back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make report</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put markers right…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A marker is wrong or missing here (Shift+F10)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading the session…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Notes: {notes}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pain (0–10): {pains}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Let it count again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Path of the wrist, with the hand’s axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ways of the finger tips</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ways of the joints: {finger}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repetition {number} of {count} · {time}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} markers hidden</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Scrubber</name>
    <message>
        <source>Time in the session</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SessionList</name>
    <message>
        <source>Sessions</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SessionsScreen</name>
    <message>
        <source>No session yet.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open in review</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare in &amp;progress</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare with a &amp;reference…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Move to another patient…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change the &amp;exercise…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Archive or &amp;delete…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions of {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Take back: let it count</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Set aside…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It then counts in the other patient’s progress, and no more in that of {name}.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>To whom does this session belong?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move it there</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which exercise was it?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Repetitions and figures are worked out anew. The recording itself is not changed.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It was this one</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SetAsideSheet</name>
    <message>
        <source>Set this session aside?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It stays in the list and can be opened, but counts nowhere. It can be taken back.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>wrong exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>trial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>discs lost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pain</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Let it count</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SetSheet</name>
    <message>
        <source>Set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No names of patients</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name of the set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Add an exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Delete this set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keep the set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sets of exercises</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exercises that run one after the other with the same markers. Each becomes a session of its own.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How much</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New set</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The set needs a name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The set needs an exercise.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Another set has this name.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Delete “{name}”? Press again</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SettingUp</name>
    <message>
        <source>The camera is being opened.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The recording is being opened.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The simulated patient is drawn, once for each exercise: a minute, up to three on a busy computer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose the source again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The depth of {name} lies {px} pixels beside its colours.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The recording itself is not changed. It does not say that its depth was laid on its colours.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open it again with the depth moved onto the colours, then click the markers anew.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave it as it is</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open it again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SettingsScreen</name>
    <message>
        <source>Light</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dark</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Change…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Initials on reports</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As in the papers: deviation first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>ISB: flexion first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Off</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stream live values</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No sound</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One beep at the goal</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Agree within</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Done</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Looks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Colours</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Text size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Data</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Sessions and the list of patients. Private to you; nothing leaves this computer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Order of the wrist’s angles in review, progress and reports. Session files keep the papers’ order; sessions in different orders are never compared.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Other programs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>While a hand is measured, its angles, places and events can go out over Lab Streaming Layer. Any computer in the same network can read them; no name and no picture is in them. From the next set-up on.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The patient’s view</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A second screen, or a window of its own, that shows the patient what to do. It opens from the screen one measures on; whether it speaks to a child or an adult is chosen with the exercise.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Agreement</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The most that Carpus and another measurement may differ by and still stand for each other: what would not change your treatment. Set it before you compare; with none, nothing is judged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click a key and press another one. While measuring only the space bar and function keys are safe.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Usual keys again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>About Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Version {version}, MIT licence.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carpus asks nobody whether there is a newer version, and sends nothing. To look yourself, compare this version with the newest one where you got Carpus from; its list of changes says what is new. Install it over this one: patients, sessions and settings stay. Make a back-up before.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Parts and their licences</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure the clinic’s own limits…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{key} already does: {action}.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SpotQuestion</name>
    <message>
        <source>Is this blue spot the {marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Yes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Which one is the {marker}?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Disc 1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Spot 2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Neither</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>StartAngleSheet</name>
    <message>
        <source>The wrist cannot lie straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Measure with a goniometer how far the wrist is from straight as it lies now. Carpus adds these angles to all it measures of the wrist and says so in the report. Bent fingers are fine as they are: zero of a finger joint is the straight finger, whatever the picture.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>It lies straight</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Use these angles</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>StraightFingers</name>
    <message>
        <source>Do the fingers lie straight?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{finger} bent</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Click a finger that cannot lie straight (keys 1 to 5).</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A bent finger is measured from its own rest, and less surely.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>SwitchingEncryption</name>
    <message>
        <source>Too many tries. The next one in {seconds} s.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The PIN until now is another one.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Teller</name>
    <message>
        <source>Go on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A session of {name} was cut short on {day} at {time}. It has been recovered.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All data up to {kept} are safe; at most the last second is missing.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Review it now, or leave it for later: it stays in the patient&apos;s list.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Waiting for the camera … {seconds} s</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>TopBar</name>
    <message>
        <source>Help (F1)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Settings (Ctrl+,)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Back from {name}</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>After the recording</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ValueField</name>
    <message>
        <source>A number from {least} to {most}, or empty</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{value}? Usual is {low} to {high}</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>VerdictPanel</name>
    <message>
        <source>good</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>wrong</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>open</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>WayButton</name>
    <message>
        <source>{name}, you are here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{name}, done</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>WaysView</name>
    <message>
        <source>Ways in three planes</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>Welcome</name>
    <message>
        <source>Screen</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{width} × {height} for windows</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Choose more pixels, or a smaller scale, in the display settings: {width} × {height} or more.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Install Carpus again: part of it is missing or damaged.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fonts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the program’s own cannot be used</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera driver</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Camera rights</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Disk</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>WelcomePanel</name>
    <message>
        <source>Another &amp;folder…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Guide me through a first session</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Esc</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Welcome to Carpus</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Patients and sessions will lie here; nothing leaves this computer.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This computer is being looked at …</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>This computer has everything that Carpus needs.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One thing is to be done; the practice patient needs none of it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>{count} things are to be done; the practice patient needs none of them.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The folder counts from the next start on: close Carpus and open it again before you measure.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>ZoomCard</name>
    <message>
        <source>Zoom, copy and save</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save picture (PNG)…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save drawing (SVG)…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save values (CSV)…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>_Nobody</name>
    <message>
        <source>No patient “{name}”.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Create “{name}”</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No patients yet. Add the first one, or try everything with the practice patient.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>self.shell</name>
    <message>
        <source>Folder of patients and sessions</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>sheet</name>
    <message>
        <source>Exercise</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>seconds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Times or seconds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How often or how long</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Earlier</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Remove</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>shell</name>
    <message>
        <source>Re&amp;view it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>I have read it</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
