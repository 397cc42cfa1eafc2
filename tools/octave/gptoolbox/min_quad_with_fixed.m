function [Z, F, Lambda, Lambda_known] = min_quad_with_fixed(A, B, known, Y, Aeq, Beq, F)
%MIN_QUAD_WITH_FIXED  Minimizes Z' * A * Z + Z' * B with Z(known, :) = Y and Aeq * Z = Beq.
%
%   Z = min_quad_with_fixed(A, B, known, Y)
%   Z = min_quad_with_fixed(A, B, known, Y, Aeq, Beq)
%   [Z, F] = ...              F: what can be used again
%   Z = min_quad_with_fixed(A, B, known, Y, Aeq, Beq, F)   only B, Y and Beq are read, and known
%   [Z, F, Lambda, Lambda_known] = ...   also the Lagrange multipliers of Aeq and of Y
%
%   Takes the place of gptoolbox's function of this name, with its arguments, if this folder comes
%   before it on the path. B, Y and Beq have one column, or one for each column of Z; [] is zero.
%   A and Aeq are sparse or full. The factor is a sparse_local; a singular system is an error.
%
%   Where Aeq is empty and b and x are wanted in few rows only, F.factor and F.unknown give local
%   solves: F.factor.local(I, b, J) in the numbering of A(F.unknown, F.unknown).
%
%   See also sparse_local.

    if nargin < 5, Aeq = []; end
    if nargin < 6, Beq = []; end
    if nargin < 7 || isempty(F), F = prepare(A, known, Aeq); end
    u = F.unknown;
    if isempty(Y), Y = zeros(numel(F.known), 1); end
    if isempty(B), B = zeros(F.n, 1); end
    if isempty(Beq), Beq = zeros(numel(F.blank), 1); end
    columns = max([size(Y, 2), size(B, 2), size(Beq, 2)]);
    Y = spread(Y, columns);
    B = spread(B, columns);
    Beq = spread(Beq, columns);
    if any(F.blank)
        gap = F.Aeq_blank * Y - Beq(F.blank, :);
        if any(abs(gap(:)) > 1e-10 * max(abs(Y(:))))
            error('min_quad_with_fixed:blank', 'an equality among known values does not hold');
        end
        Beq = Beq(~F.blank, :);
    end
    right = [-0.5 * B(u, :); Beq] - F.coupling * Y;
    if F.equalities > 0
        x = F.factor.refine(F.matrix, right);
    else
        x = F.factor.solve(right);
    end
    Z = zeros(F.n, columns);
    Z(F.known, :) = Y;
    Z(u, :) = x(1:numel(u), :);
    Lambda = x(numel(u) + 1:end, :);
    Lambda_known = -(F.rows_known * Z + 0.5 * B(F.known, :) + F.Aeq_known' * Lambda);
end

function F = prepare(A, known, Aeq)
    % The factor of the rows that are not known, with the equalities.
    n = size(A, 1);
    if isempty(Aeq), Aeq = sparse(0, n); end
    if islogical(known), known = find(known); end
    A = sparse(double(A));
    Aeq = sparse(double(Aeq));
    A = (A + A') / 2; % the energy depends on nothing else
    F.n = n;
    F.known = known(:);
    is_known = false(n, 1);
    is_known(F.known) = true;
    F.unknown = find(~is_known);
    F.blank = ~any(Aeq(:, F.unknown), 2); % equalities among known values only
    F.Aeq_blank = Aeq(F.blank, F.known);
    Aeq = Aeq(~F.blank, :);
    F.equalities = size(Aeq, 1);
    F.coupling = [A(F.unknown, F.known); Aeq(:, F.known)];
    F.rows_known = A(F.known, :);
    F.Aeq_known = Aeq(:, F.known);
    E = Aeq(:, F.unknown);
    F.matrix = [A(F.unknown, F.unknown), E'; E, sparse(F.equalities, F.equalities)];
    try
        F.factor = sparse_local(F.matrix, 'pivoted', F.equalities > 0);
    catch e
        singular = strcmp(e.identifier, 'sparse_local:pivot');
        if ~singular && ~strcmp(e.identifier, 'sparse_local:inaccurate'), rethrow(e); end
        if F.equalities > 0, in_original_rows(e, F); end
        try % an energy without a minimum may still have a stationary point
            F.factor = sparse_local(F.matrix, 'pivoted', true);
        catch
            in_original_rows(e, F);
        end
    end
end

function in_original_rows(e, F)
    % The error of the factor, with the row of A, or the equality.
    row = regexp(e.message, '\(row (\d+)', 'tokens');
    where = '';
    if ~isempty(row)
        row = str2double(row{1}{1});
        if row <= numel(F.unknown)
            where = sprintf('; this is row %d of A', F.unknown(row));
        else
            where = sprintf('; this is equality %d', row - numel(F.unknown));
        end
    end
    error(e.identifier, '%s%s', e.message, where);
end

function M = spread(M, columns)
    % One column for each column of Z.
    if size(M, 2) == 1 && columns > 1, M = repmat(M, 1, columns); end
end
